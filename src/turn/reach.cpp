#include <algorithm>
#include <cmath>

#include "space/search.hpp"
#include "turn/levels.hpp"
#include "turn/way.hpp"

namespace poise {
namespace turns {
namespace {

/// The part of what is open between the bound and the best in which triangles are cut in one go.
constexpr double at_once = 0.3;

/// The search for the lowest posture that is connected to where it is now by postures that need no
/// more.
class ReachSearch {
 public:
  ReachSearch(const Grasp<3>& grasp, const Vector<3>& from, const Vector<3>& towards,
              const TurnSettings& settings)
      : settings_(settings), values_(grasp, settings) {
    if (!values_.is_in_domain(from)) values_.forget_domain();
    now_ = values_.at(from);
    towards_ = towards;
    gap_ = values_.gap_of_p(settings.gap);
    most_ = now_.p / (1 - gap_);
  }

  Reachable<3> find() {
    if (!now_.holdable()) throw InvalidGrasp("from", "cannot be held");
    best_ = now_.x;
    best_p_ = now_.p;
    ups_ = {now_.x};
    search();
    return result();
  }

 private:
  bool is_done() const { return best_p_ <= nothing || best_p_ - proven_ <= gap_ * best_p_; }

  void search() {
    Mesh mesh(values_, now_.x, towards_);
    while (values_.holds() < settings_.max_holds) {
      const Levels reached = levels_reached(mesh, 0);
      lowest_corner_ = 0;
      for (std::size_t k = 0; k < mesh.corners().size(); ++k)
        if (reached.p[k] <= most_ && mesh.corners()[k].p < mesh.corner(lowest_corner_).p)
          lowest_corner_ = static_cast<int>(k);
      best_p_ = mesh.corner(lowest_corner_).p;
      best_ = mesh.corner(lowest_corner_).x;
      ups_.clear();
      for (const int k : reached.way(lowest_corner_)) ups_.push_back(mesh.corner(k).x);
      const std::vector<int> lowest = lowest_triangles(mesh);
      if (is_done()) break;
      const auto& corners = mesh.triangle(lowest.front()).corners;
      const auto doubtful = doubtful_on_way(mesh, 0, {corners.begin(), corners.end()}, most_);
      if (!refine(mesh, doubtful.empty() ? lowest : doubtful)) break;
    }
    if (ups_.size() > 1) ups_ = fewest_steps(values_, ups_, most_);
  }

  /// Of the triangles that may be reached those that may need least, the lowest first: a part of
  /// what is open. Says what all of them need at least.
  std::vector<int> lowest_triangles(const Mesh& mesh) {
    const Levels levels = levels_proven(mesh, 0, std::nextafter(now_.p, infinity));
    std::vector<int> open;
    for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
      const Triangle& triangle = mesh.triangles()[t];
      if (levels.to(triangle.corners[0]) <= now_.p && triangle.least < best_p_)
        open.push_back(static_cast<int>(t));
    }
    const auto least = [&](int t) { return mesh.triangle(t).least; };
    std::sort(open.begin(), open.end(), [&](int a, int b) { return least(a) < least(b); });
    proven_ = open.empty() ? best_p_ : least(open.front());
    const double level = proven_ + at_once * (best_p_ - proven_);
    while (!open.empty() && least(open.back()) > level) open.pop_back();
    return open;
  }

  Reachable<3> result() {
    Reachable<3> found{values_.posture(best_), values_.value(proven_), {}};
    found.way.status = is_done() ? Status::optimal : Status::gap;
    found.way.ups = ups_;
    found.way.lower_bound = values_.value(now_.p);
    found.way.peak =
        values_.value(ups_.size() > 1 ? peak_along(values_, ups_, gap_ / 8).most : now_.p);
    found.way.holds = values_.holds();
    return found;
  }

  const TurnSettings& settings_;
  Values values_;
  Valued now_;
  Vector<3> towards_, best_;
  double gap_{0}, most_{0}, best_p_{0}, proven_{0};
  int lowest_corner_{0};
  std::vector<Vector<3>> ups_;
};

}  // namespace
}  // namespace turns

Reachable<3> best_reachable(const Grasp<3>& grasp, const Vector<3>& from, const Vector<3>& towards,
                            const TurnSettings& settings) {
  search::check_search(settings);
  turns::check_unit("from", from);
  turns::check_unit("towards", towards);
  return turns::ReachSearch(grasp, from.normalized(), towards.normalized(), settings).find();
}

}  // namespace poise
