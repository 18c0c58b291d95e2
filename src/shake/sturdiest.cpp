// The posture that withstands most: docs/theory.md, "Shake". What can be supplied knows nothing of
// the posture, so the cuts of one posture bound all others: branch and bound over the sphere.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <tuple>
#include <utility>

#include "hold/solve.hpp"
#include "shake/settings.hpp"
#include "space/search.hpp"

namespace poise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double tie = 1e-6;
constexpr std::size_t most_cells = 200000;
constexpr int more_holds = 10;  ///< than for one load of one posture

/// Postures up to an angle away from one, at most pi.
template <int Dim>
struct Range {
  Vector<Dim> from;
  double most;

  /// The posture of it that is nearest to another.
  Vector<Dim> nearest(const Vector<Dim>& up) const {
    if (up.dot(from) >= std::cos(most)) return up;
    const Vector<Dim> across = up - up.dot(from) * from;
    if (!(across.norm() > 0)) return from;
    return std::cos(most) * from + std::sin(most) * across.normalized();
  }
};

/// An arc or a triangle of the sphere, with a bound on what its postures withstand.
template <int Dim>
struct Cell {
  std::array<Vector<Dim>, Dim> corners;
  double bound{infinity};
  std::size_t known{0};  ///< how many cuts the bound takes into account
  std::size_t by{0};     ///< the one that it comes from

  bool operator<(const Cell& other) const { return bound < other.bound; }

  Vector<Dim> center() const {
    Vector<Dim> sum = Vector<Dim>::Zero();
    for (const Vector<Dim>& corner : corners) sum += corner;
    return sum.normalized();
  }
  /// Of the angle between its center and the farthest corner.
  double cosine() const {
    const Vector<Dim> middle = center();
    double least = 1;
    for (const Vector<Dim>& corner : corners) least = std::min(least, middle.dot(corner));
    return least;
  }
  /// Cut at the middle of its longest edge.
  std::array<Cell, 2> halves() const {
    std::size_t a = 0, b = 1;
    for (std::size_t i = 0; i < Dim; ++i)
      for (std::size_t j = i + 1; j < Dim; ++j)
        if (corners[i].dot(corners[j]) < corners[a].dot(corners[b])) std::tie(a, b) = {i, j};
    const Vector<Dim> middle = (corners[a] + corners[b]).normalized();
    std::array<Cell, 2> parts{*this, *this};
    parts[0].corners[a] = parts[1].corners[b] = middle;
    return parts;
  }
};

std::vector<Cell<2>> cells_of(const Range<2>& range) {
  constexpr int count = 8;
  const double start = angle_of(range.from) - range.most, step = 2 * range.most / count;
  std::vector<Cell<2>> cells;
  for (int k = 0; k < count; ++k)
    cells.push_back({{up_at(start + k * step), up_at(start + (k + 1) * step)}});
  return cells;
}

std::vector<Cell<3>> cells_of(const Range<3>&) {
  std::vector<Cell<3>> cells;
  for (const double x : {1.0, -1.0})
    for (const double y : {1.0, -1.0})
      for (const double z : {1.0, -1.0})
        cells.push_back({{x * Vector<3>::UnitX(), y * Vector<3>::UnitY(), z * Vector<3>::UnitZ()}});
  return cells;
}

template <int Dim>
class Search {
 public:
  Search(const Grasp<Dim>& grasp, const Range<Dim>& range, const ShakeSettings& settings)
      : grasp_(grasp), range_(range), settings_(settings) {
    check_shake(settings);
    for (const Load<Dim>& load : grasp.loads())
      ones_.emplace_back(load, grasp.contacts(), 1, grasp.mechanism());
    for (const Grasp<Dim>& one : ones_) hands_.push_back(limited_hand<Dim>(one, settings));
    for (std::size_t k = 0; k < ones_.size(); ++k)
      supplies_.emplace_back(hands_[k], grasp.loads()[k], settings.force_cap);
    known_.resize(ones_.size());
    for (Cell<Dim>& cell : cells_of(range_)) add(std::move(cell));
  }

  Sturdiest<Dim> run(const Vector<Dim>& present) {
    check_up<Dim>(present);
    visit(range_.nearest(present));
    const long most_holds = long{more_holds} * settings_.max_holds;
    std::size_t cells = 0;
    while (!is_near(next())) {
      if (holds_ >= most_holds || ++cells > most_cells) break;
      const Cell<Dim> cell = cells_.top();
      cells_.pop();
      const Vector<Dim> up = range_.nearest(cell.center());
      if (bound_at(up) > enough()) visit(up);
      for (Cell<Dim>& half : cell.halves()) add(std::move(half));
    }
    return result();
  }

 private:
  /// A half-space of what a load can be supplied with. Equation (18) of docs/theory.md.
  struct Known {
    std::size_t load;
    double gravity;
    SupplyCut<Dim> cut;

    /// What it leaves of accelerations with x for up.
    double left(const Vector<Dim>& x) const {
      if (cut.n.isZero(0)) return cut.b < 0 ? -infinity : infinity;
      return cut.b - gravity * cut.n.dot(x);
    }
  };

  double enough() const {
    return best_ < 0 ? 0 : std::max(best_ * (1 + settings_.gap / 2), best_ + no_acceleration);
  }
  bool is_near(double bound) const { return bound <= enough(); }

  double bound_at(const Vector<Dim>& up) const {
    double least = infinity;
    for (const Known& each : cuts_) least = std::min(least, each.left(up));
    return least;
  }

  /// Takes into account what was found since. The postures of a cell are vectors of the hull of its
  /// corners, made longer by at most 1 / cosine.
  void update(Cell<Dim>& cell) const {
    const double longest = 1 / cell.cosine();
    for (; cell.known < cuts_.size(); ++cell.known) {
      const Known& each = cuts_[cell.known];
      double most = -infinity;
      for (const Vector<Dim>& corner : cell.corners)
        most = std::max({most, each.left(corner), each.left(longest * corner)});
      if (!(most < cell.bound)) continue;
      cell.bound = most;
      cell.by = cell.known;
    }
  }

  void add(Cell<Dim> cell) {
    const double cosine = cell.cosine();
    const auto angle = [](double along) { return std::acos(std::clamp(along, -1.0, 1.0)); };
    if (angle(cell.center().dot(range_.from)) > range_.most + angle(cosine) + 1e-12) return;
    cell.known = 0;  // what the whole knows bounds a half better
    update(cell);
    cells_.push(std::move(cell));
  }

  /// The greatest bound of the cells.
  double next() {
    while (cells_.top().known < cuts_.size()) {
      Cell<Dim> cell = cells_.top();
      cells_.pop();
      update(cell);
      cells_.push(std::move(cell));
    }
    return cells_.top().bound;
  }

  /// Measures what a posture withstands, as far as that may be more than what is known.
  void visit(const Vector<Dim>& up) {
    ShakeSettings near = settings_;
    near.gap /= 4;
    double least = infinity;
    for (std::size_t k = 0; k < supplies_.size() && least > best_; ++k) {
      const Supply<Dim>& supply = supplies_[k];
      const Ball<Dim> ball{supply.at(up)};
      Body<Dim> body(supply, ball.center, known_[k]);
      Wanted wanted = wanted_shake(near, least);
      wanted.needed = std::max(enough(), 0.0);
      if (grasp_.loads()[k].weight > 0)
        body.measure(ball, wanted);
      else
        body.only_inside();
      holds_ += body.holds;
      for (std::size_t j = known_[k].size(); j < body.cuts().size(); ++j)
        cuts_.push_back({k, supply.gravity(), body.cuts()[j]});
      known_[k] = body.cuts();
      least = body.holdable ? std::min(least, body.reach) : -infinity;
    }
    if (!(least > best_ * (1 + tie))) return;
    best_ = least;
    up_ = up;
  }

  Sturdiest<Dim> result() {
    Sturdiest<Dim> found{.status = Status::gap, .bound = cells_.top().bound, .holds = holds_};
    if (best_ >= 0) {
      found.up = up_;
      found.acceleration = infinity;
      ShakeSettings near = settings_;
      near.gap /= 4;
      for (const Grasp<Dim>& one : ones_) {
        Shake<Dim>& own = found.shakes.emplace_back(shake<Dim>(one, up_, near));
        own.proven = own.proven || own.bound <= most_for(own.acceleration);
        found.holds += own.holds;
        found.acceleration = std::min(found.acceleration, own.acceleration);
      }
      if (best_ == infinity) found.bound = infinity;
      found.bound = std::max(found.bound, found.acceleration);
      if (found.bound <= most_for(found.acceleration)) found.status = Status::optimal;
    } else if (found.bound < 0) {
      found.status = Status::unholdable;
      found.bound = 0;
    }
    if (found.bound < infinity) found.cuts = needed_cuts();
    return found;
  }

  /// The highest bound that is near enough.
  double most_for(double acceleration) const {
    return acceleration * (1 + settings_.gap) + no_acceleration;
  }

  std::vector<ShakeCut<Dim>> needed_cuts() {
    std::vector<char> needed(cuts_.size(), 0);
    for (; !cells_.empty(); cells_.pop()) needed[cells_.top().by] = 1;
    std::vector<ShakeCut<Dim>> kept;
    for (std::size_t k = 0; k < cuts_.size(); ++k)
      if (needed[k] != 0) kept.push_back({cuts_[k].load, cuts_[k].cut.y, cuts_[k].cut.rates});
    return kept;
  }

  const Grasp<Dim>& grasp_;
  Range<Dim> range_;
  ShakeSettings settings_;
  std::vector<Grasp<Dim>> ones_;  ///< one for each load
  std::vector<Hand<Dim>> hands_;
  std::vector<Supply<Dim>> supplies_;
  std::vector<std::vector<SupplyCut<Dim>>> known_;  ///< of each load
  std::vector<Known> cuts_;                         ///< of all
  std::priority_queue<Cell<Dim>> cells_;
  double best_{-infinity};
  Vector<Dim> up_ = Vector<Dim>::Zero();
  int holds_{0};
};

}  // namespace

Sturdiest<2> sturdiest_posture(const Grasp<2>& grasp, Domain domain, const ShakeSettings& settings,
                               const Vector<2>& present) {
  const Interval all = domain_interval(grasp, domain);
  const Range<2> range{up_at((all.from + all.to) / 2), (all.to - all.from) / 2};
  return Search<2>(grasp, range, settings).run(present);
}

Sturdiest<3> sturdiest_posture(const Grasp<3>& grasp, const std::optional<Tilt>& tilt,
                               const ShakeSettings& settings, const Vector<3>& present) {
  Range<3> range{Vector<3>::UnitZ(), std::numbers::pi};
  if (tilt) {
    search::check_tilt(*tilt);
    range = {tilt->from.normalized(), tilt->most};
  }
  return Search<3>(grasp, range, settings).run(present);
}

}  // namespace poise
