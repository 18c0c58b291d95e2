#include "turn/way.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "space/search.hpp"
#include "turn/wall.hpp"

namespace poise {
namespace turns {

using std::numbers::pi;

namespace {

/// Longer steps [rad] are between opposite postures.
constexpr double longest_step = pi - 1e-6;
/// Smaller angles [rad] are no turn.
constexpr double no_turn = 1e-12;

}  // namespace

std::vector<Vector<3>> fewest_steps(Values& values, const std::vector<Vector<3>>& ups,
                                    double most) {
  std::vector<Vector<3>> steps{ups.front()};
  const auto is_low = [&](std::size_t from, std::size_t to) {
    const Arc arc = arc_between(ups[from], ups[to]);
    return arc.angle < longest_step &&
           peak_of(values, arc, 1e-12, most, holds_per_step).most <= most;
  };
  for (std::size_t k = 0; k + 1 < ups.size();) {
    std::size_t good = k + 1, bad = ups.size();
    if (is_low(k, ups.size() - 1)) good = ups.size() - 1;
    while (good + 1 < bad) {
      const std::size_t middle = (good + bad) / 2;
      (is_low(k, middle) ? good : bad) = middle;
    }
    steps.push_back(ups[good]);
    k = good;
  }
  return steps;
}

Enclosure peak_along(Values& values, const std::vector<Vector<3>>& ups, double gap) {
  Enclosure worst;
  for (std::size_t k = 0; k + 1 < ups.size(); ++k) {
    Enclosure step =
        peak_of(values, arc_between(ups[k], ups[k + 1]), gap, infinity, holds_per_step);
    const double most = std::max(worst.most, step.most);
    if (!(step.least < worst.least)) worst = std::move(step);
    worst.most = most;
  }
  return worst;
}

namespace {

/// How far beside the only great circle of postures that can be held a wall leaves it.
constexpr double beside_circle = 1e-6;

class WaySearch {
 public:
  WaySearch(const Grasp<3>& grasp, const Vector<3>& from, const Vector<3>& to,
            const TurnSettings& settings)
      : settings_(settings), values_(grasp, settings) {
    if (!values_.is_in_domain(from) || !values_.is_in_domain(to)) values_.forget_domain();
    from_ = values_.at(from);
    to_ = values_.at(to);
    gap_ = values_.gap_of_p(settings.gap);
  }

  Way find() {
    // Whatever the way, its ends are on it.
    for (const Valued* end : {&from_, &to_})
      lower_ = std::max(lower_, values_.least_between(end->half_space, end->x, end->x));
    if (!(lower_ < infinity)) return result();
    const Arc straight = arc_between(from_.x, to_.x);
    take(straight, peak_of(values_, straight, gap_ / 2, infinity, left()).most);
    if (!is_done()) {
      if (values_.oracle().thin.empty())
        search_sphere();
      else
        search_circle();
    }
    return result();
  }

 private:
  bool is_done() const {
    return upper_ <= nothing || (upper_ < infinity && upper_ - lower_ <= gap_ * upper_);
  }
  int left() const { return settings_.max_holds - values_.holds(); }

  void take(std::vector<Vector<3>> ups, double most) {
    if (!(most < upper_)) return;
    ups_ = std::move(ups);
    upper_ = most;
  }

  /// A part of a great circle as a way, in steps of which each is the smallest turn.
  void take(const Arc& arc, double most) {
    const int parts = arc.angle < longest_step ? 1 : 1 + static_cast<int>(arc.angle / (0.7 * pi));
    std::vector<Vector<3>> ups{from_.x};
    for (int k = 1; k < parts; ++k) ups.push_back(arc.at(arc.angle * k / parts));
    if (arc.angle > no_turn) ups.push_back(to_.x);
    take(std::move(ups), most);
  }

  void search_sphere() {
    Mesh mesh(values_, from_.x, to_.x);
    double reached = upper_, proven = lower_;
    const double half = gap_ / 2;  // the other half is for steps
    const auto is_open = [&] {
      const bool is_close =
          reached <= nothing || (reached < infinity && reached - proven <= half * reached);
      return !is_close && proven < infinity;
    };
    while (is_open() && left() > 0) {
      const Levels levels = levels_reached(mesh, 0);
      proven = std::max(lower_, levels_proven(mesh, 0).to(1));
      reached = std::min(upper_, levels.to(1));
      if (!is_open()) break;
      const double level =
          reached < infinity ? (proven + reached) / 2 : std::numeric_limits<double>::max();
      if (!refine(mesh, doubtful_on_way(mesh, 0, {1}, level))) break;
    }
    if (proven > lower_) {
      std::vector<Stone> wall = wall_of(values_, mesh, proven);
      if (separates(wall, from_.x, to_.x)) {
        lower_ = proven;
        wall_ = std::move(wall);
      }
    }
    const Levels levels = levels_reached(mesh, 0);
    if (!(levels.to(1) < upper_)) return;
    std::vector<Vector<3>> ups;
    for (const int corner : levels.way(1)) ups.push_back(mesh.corner(corner).x);
    const double most = std::max(levels.to(1), lower_ / (1 - gap_));
    ups = fewest_steps(values_, ups, most);
    const double peak = peak_along(values_, ups, half / 4).most;
    take(std::move(ups), peak);
  }

  /// A motion that nothing resists leaves but a great circle of postures. There are two ways round.
  void search_circle() {
    const std::vector<HalfSpace>& sides = values_.oracle().unresisted;
    const Arc straight = arc_between(from_.x, to_.x, sides.front().normal.cross(from_.x));
    const Arc other{from_.x, -straight.across, 2 * pi - straight.angle};
    const Enclosure first = peak_of(values_, straight, gap_ / 2, infinity, left());
    const Enclosure second = peak_of(values_, other, gap_ / 2, infinity, left());
    take(straight, first.most);
    take(other, second.most);
    // Across the circle where each way needs most, and else beside it.
    const Vector<3> n = straight.from.cross(straight.across);
    const auto beyond = [&](double side) -> const HalfSpace* {
      for (const HalfSpace& each : sides)
        if (side * each.normal.dot(n) > 1 - 1e-9) return &each;
      return nullptr;
    };
    const HalfSpace *above = beyond(1), *below = beyond(-1);
    if (above == nullptr || below == nullptr) return;
    const auto beside = [&](const Enclosure& found, double side) {
      return Vector<3>((found.posture.x + side * beside_circle * n).normalized());
    };
    std::vector<Stone> wall{
        {beside(first, -1), first.posture.half_space},  {beside(first, 1), *above},   {n, *above},
        {beside(second, 1), second.posture.half_space}, {beside(second, -1), *below}, {-n, *below}};
    double proven = infinity;
    for (std::size_t k = 0; k < wall.size(); ++k)
      proven = std::min(proven, values_.least_between(wall[k].half_space, wall[k].up,
                                                      wall[(k + 1) % wall.size()].up));
    if (proven > lower_ && separates(wall, from_.x, to_.x)) {
      lower_ = proven;
      wall_ = std::move(wall);
    }
  }

  Way result() const {
    Way way;
    way.holds = values_.holds();
    way.lower_bound = values_.value(std::min(lower_, upper_));
    if (upper_ < infinity) {
      way.ups = ups_;
      way.peak = values_.value(upper_);
      way.status = is_done() ? Status::optimal : Status::gap;
    } else if (!(lower_ < infinity)) {
      way.status = Status::unholdable;
    }
    const double level = lower_ < infinity ? lower_ : 1.005 * std::sqrt(values_.oracle().most);
    for (const Stone& stone : wall_)
      way.wall.push_back({stone.up, values_.cut(stone.half_space, level)});
    return way;
  }

  const TurnSettings& settings_;
  Values values_;
  Valued from_, to_;
  double gap_{0}, lower_{0}, upper_{infinity};
  std::vector<Vector<3>> ups_;
  std::vector<Stone> wall_;
};

}  // namespace
}  // namespace turns

Way least_peak_way(const Grasp<3>& grasp, const Vector<3>& from, const Vector<3>& to,
                   const TurnSettings& settings) {
  search::check_search(settings);
  turns::check_unit("from", from);
  turns::check_unit("to", to);
  return turns::WaySearch(grasp, from.normalized(), to.normalized(), settings).find();
}

}  // namespace poise
