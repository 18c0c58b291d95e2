#include "poise/best_spatial_posture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ascend.hpp"
#include "polytope.hpp"
#include "twist.hpp"

namespace poise {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A scenario in the units of the search: efforts in squared weights of the heaviest.
struct Scenario {
  const Grasp<3>* grasp;
  double weight;  ///< in weights of the heaviest
  double cap;     ///< in its own weights
};

/// For every x in R^3, load x through the com of the scenario: effort >= weight^2 2 (v . x - phi),
/// v the velocity of the com under y. Or a plane n . x <= 0 of the domain.
struct Row {
  Vector<3> n;  ///< v / |v|
  double speed{0}, phi{0};
  Twist<3> y = Twist<3>::Zero();  ///< about the com, in the solver's units
  std::size_t scenario{0};
  Vector<3> at = Vector<3>::Zero();  ///< where y is optimal
  bool holdable{false}, plane{false};
};

struct Load {
  Vector<3> x;
  double V;
};

struct Evaluation {
  double V{infinity};  ///< infinite where unholdable
  Row row;
};

/// Postures at most an angle away from a direction.
struct Cone {
  Vector<3> axis;
  double most;

  /// By how much x is outside [rad].
  double excess(const Vector<3>& x) const {
    return std::atan2(axis.cross(x).norm(), axis.dot(x)) - most;
  }
  /// The unit vector across the axis towards x.
  Vector<3> across(const Vector<3>& x) const {
    const Vector<3> beside = x - axis.dot(x) * axis;
    return beside.norm() > 1e-12 * x.norm() ? Vector<3>(beside.normalized())
                                            : Vector<3>(tangents(axis).col(0));
  }
  /// The plane n . x <= 0 that touches the cone on x's side.
  Vector<3> plane(const Vector<3>& x) const {
    if (most >= pi / 2 || axis.dot(x) < 0) return -axis;
    return std::cos(most) * across(x) - std::sin(most) * axis;
  }
  Vector<3> nearest(const Vector<3>& x) const {
    if (!(excess(x) > 0)) return x.normalized();
    return std::cos(most) * axis + std::sin(most) * across(x);
  }
};

struct Plane {
  Vector<3> n;  ///< of length 1
  double b;     ///< n . x = b
};

/// The point nearest to x on these planes, as the sum of what they fix and what they leave; x
/// itself where they have no more than a point in common.
struct OnPlanes {
  OnPlanes(const Vector<3>& x, const std::vector<Plane>& planes) : along(x) {
    std::vector<Plane> basis;
    for (Plane plane : planes) {
      for (const Plane& other : basis) {
        const double part = other.n.dot(plane.n);
        plane.n -= part * other.n;
        plane.b -= part * other.b;
      }
      const double left = plane.n.norm();
      if (left > 1e-4) basis.push_back({plane.n / left, plane.b / left});
    }
    if (basis.size() > 2) return;
    for (const Plane& plane : basis) {
      along -= plane.n.dot(along) * plane.n;
      fixed += plane.b * plane.n;
    }
  }
  Vector<3> load() const { return fixed + along; }
  /// The posture in this direction; `up` if there is none.
  Vector<3> posture(const Vector<3>& up) const {
    const double rest = 1 - fixed.squaredNorm();
    if (!(along.norm() > 1e-3) || !(rest > 0)) return up;
    return (fixed + std::sqrt(rest) * along.normalized()).normalized();
  }
  Vector<3> fixed = Vector<3>::Zero(), along;
};

/// The postures in which one contact may carry all: it is right under the com, or above it.
std::vector<Vector<3>> on_one_contact(const Grasp<3>& grasp) {
  std::vector<Vector<3>> ups;
  for (const Contact<3>& contact : grasp.contacts()) {
    const Vector<3> arm = grasp.object().com - contact.position;
    const bool at_com = arm.norm() <= 1e-9 * grasp.radius();
    const Vector<3> along = at_com ? contact.normal : Vector<3>(arm.normalized());
    const double normal = contact.normal.dot(along);
    const double beside = (along - normal * contact.normal).norm();
    if (beside <= contact.friction * std::abs(normal) + 1e-9)
      ups.push_back(normal > 0 ? along : -along);
  }
  return ups;
}

/// Minimises the greatest effort of the scenarios over the unit vectors of all cones.
class Search {
 public:
  /// `rough`: with holds to the digits that doubles give at once, for what needs no proof.
  Search(const std::vector<Scenario>& scenarios, std::vector<Cone> cones, double gap, int max_holds,
         bool rough = false)
      : scenarios_(scenarios),
        cones_(std::move(cones)),
        gap_(gap),
        max_holds_(max_holds),
        rough_(rough) {
    for (const Scenario& s : scenarios) {
      limited_ = limited_ || s.grasp->scaled().limited;
      cap_ = std::max(cap_, s.cap * s.weight);
    }
    // |f| >= W / sqrt(sum share), by y = t e_k.
    const ScaledGrasp<3>& grasp = scenarios.front().grasp->scaled();
    for (std::size_t i = 0; i < grasp.size; ++i)
      shares_ += grasp.lanes[i / lane_size].share[i % lane_size];
    for (std::size_t s = 0; s < scenarios.size(); ++s)
      if (scenarios[s].weight == 1) heaviest_ = s;
    t_ = limited_ ? target() : 1;
    polytope_ = box();
    for (std::size_t s = 0; s < scenarios.size(); ++s)
      for (const Twist<3>& unfelt : scenarios[s].grasp->scaled().unfelt)
        if (unfelt.head<3>().norm() > 1e-9) {
          thin_.push_back({unfelt.head<3>().normalized(), 0});
          for (const double sign : {1.0, -1.0}) nothing_resists(s, sign * unfelt);
        }
  }

  /// V at weight `x` (unit vector: a posture), from the y of a row.
  /// Where it is far from the best, V is only rough; the row is right in any case.
  Evaluation evaluate(const Vector<3>& x, const Row* from = nullptr, bool exact = false);

  void run();
  /// Takes over what was found for the same scenarios without max_normal.
  void begin_with(const Search& easier);

  /// Turns that nobody feels leave only loads on these planes.
  const std::vector<Plane>& thin() const { return thin_; }
  double best_V() const { return best_V_; }
  const Vector<3>& best_up() const { return best_up_; }
  const Row& best_row() const { return best_row_; }
  int holds() const { return holds_; }
  double cap() const { return cap_; }
  /// What the rows prove: V >= lower_bound() in the domain.
  double lower_bound();
  /// The rows that are needed for that, as cuts.
  std::vector<Cut> certificate(double t) const;

 private:
  /// With limits loads near the unit sphere are all that counts.
  Polytope box() const {
    const double half = std::sqrt(t_ * shares_);
    return Polytope(limited_ ? std::min(half, 2.0) : half);
  }
  /// The effort whose level set is cut: with limits the rows' right-hand sides depend on it. Where
  /// nothing holds, a little above the cap, which proofs exceed by a tenth.
  double target() const {
    return std::min((1 - gap_) * (1 + 1e-3 * gap_) * best_V_, 1.01 * cap_ * cap_);
  }
  double right_hand_side(const Row& row) const;
  bool cut(std::size_t row, std::size_t hint);
  void rebuild();
  /// By more than the wanted gap would notice.
  bool improves(double V) const { return V < (1 - 1e-3 * gap_) * best_V_; }
  /// Between the target and the best.
  bool below(double V) const { return V < infinity && V <= (1 - 0.5 * gap_) * best_V_; }
  bool inside(const Vector<3>& up) const {
    return std::all_of(cones_.begin(), cones_.end(),
                       [&](const Cone& cone) { return cone.excess(up) <= 1e-9; });
  }
  /// Evaluates, remembers the row and whether it is the best.
  double visit(const Vector<3>& up, const Row* from, std::size_t hint = Polytope::none);
  std::vector<Plane> meant(const Vector<3>& x, const std::array<int, 3>& planes) const;
  Vector<3> snapped(const Vector<3>& x, const std::array<int, 3>& planes) const;
  const Row* neighbour(const Vector<3>& x, const std::array<int, 3>& planes) const;
  bool stay_inside(const Vector<3>& x, const std::array<int, 3>& planes, std::size_t vertex);
  bool shrink();
  bool recede();
  bool cross();
  bool proven() const;
  double bound_by_cuts();
  void nothing_resists(std::size_t scenario, const Twist<3>& y);

  const std::vector<Scenario>& scenarios_;
  std::vector<Cone> cones_;
  double gap_;
  int max_holds_, holds_{0};
  bool rough_, limited_{false}, heavier_is_easier_{false};
  double cap_{0}, shares_{0}, t_{1};
  std::size_t heaviest_{0};
  std::vector<Plane> thin_;
  std::vector<Row> rows_;  ///< plane 6 + i of the polytope is row i
  Polytope polytope_{1};
  double best_V_{infinity};
  Vector<3> best_up_ = Vector<3>::Zero();
  Row best_row_;
  int beyond_in_a_row_{0}, refuted_{0};
  /// Loads of the domain known to need no more: lighter than the object, and heavier.
  std::optional<Load> lighter_, heavier_;
};

Evaluation Search::evaluate(const Vector<3>& given, const Row* from, bool exact) {
  Vector<3> x = given;
  if (std::all_of(thin_.begin(), thin_.end(),
                  [&](const Plane& plane) { return std::abs(plane.n.dot(given)) < 1e-6; }))
    x = OnPlanes(given, thin_).load();
  Evaluation worst;
  worst.V = -1;
  Wrench<3> w;
  w << x, 0, 0, 0;
  for (std::size_t s = 0; s < scenarios_.size(); ++s) {
    const Scenario& scenario = scenarios_[s];
    const ScaledGrasp<3>& grasp = scenario.grasp->scaled();
    dual::Point<3> point(grasp.size);
    const Twist<3> start =
        from != nullptr && from->scenario == s ? from->y : dual::cold_start<3>(grasp, w);
    const double in_units = scenario.weight * scenario.weight;
    bool holdable = !exact && dual::approach(grasp, w, start, scenario.cap, point);
    double square = dual::squared_norm(point);
    // Where the two disagree again and again, beside what can be held, the first is not believed.
    if (holdable && !exact && !rough_ && improves(in_units * square) && refuted_ > 20) {
      holdable = false;
    } else if (exact || (!rough_ && holdable && improves(in_units * square))) {
      dual::Point<3> rough = point;
      const bool approached = holdable;
      holdable = dual::maximise(grasp, w, exact ? start : Twist<3>(point.y), scenario.cap, point);
      square = dual::squared_norm(point);
      if (approached && !holdable) ++refuted_;
      // Rounding of a load may ask for a very long y, of no use for other loads.
      if (approached && holdable && dual::span(point.y) > 1e3 * dual::span(rough.y)) point = rough;
    }
    ++holds_;
    const double V = holdable ? in_units * square : infinity;
    if (!(V > worst.V)) continue;
    worst.V = V;
    Row& row = worst.row;
    // Where nothing holds, y goes far along a direction; farther may cut deeper.
    if (limited_ && !holdable) {
      dual::Point<3> far = point;
      dual::evaluate<3, double>(grasp, w, Twist<3>(1e3 * point.y), far);
      const double half = t_ / (2 * in_units);
      if (far.value - half > 1e3 * (point.value - half)) point = far;
    }
    row.y = point.y;
    row.speed = point.y.head<3>().norm();
    row.n = point.y.head<3>() / row.speed;
    // Rounding of G^T y must not make a cut deeper than it is.
    const double rounding = 2.2e-16 * point.y.cwiseAbs().sum();
    const double norm = std::sqrt(dual::squared_norm(point)) +
                        rounding * std::sqrt(static_cast<double>(grasp.size));
    row.phi = limited_ ? point.y.dot(w) - point.value : 0.5 * norm * norm;
    row.scenario = s;
    row.at = x;
    row.holdable = holdable;
    if (!holdable) break;
  }
  return worst;
}

/// A row for a twist that no contact feels.
void Search::nothing_resists(std::size_t scenario, const Twist<3>& y) {
  const ScaledGrasp<3>& grasp = scenarios_[scenario].grasp->scaled();
  dual::Point<3> point(grasp.size);
  Row row;
  row.y = 1e8 * y;
  dual::evaluate<3, double>(grasp, Wrench<3>::Zero(), row.y, point);
  row.speed = row.y.head<3>().norm();
  row.n = row.y.head<3>() / row.speed;
  row.phi = (limited_ ? -point.value : std::max(-point.value, 0.0)) + 1e-30 * row.y.squaredNorm();
  row.scenario = scenario;
  rows_.push_back(row);
  cut(rows_.size() - 1, Polytope::none);
}

/// Of n . x where the effort is at most t_. Without limits y may be as long as is best.
double Search::right_hand_side(const Row& row) const {
  if (row.plane) return 0;
  const double weight = scenarios_[row.scenario].weight, half = t_ / (2 * weight * weight);
  const double felt = limited_ ? half + row.phi : 2 * std::sqrt(half * row.phi);
  return (felt + dual::delta * dual::length<3, double>(row.y)) / row.speed;
}

bool Search::cut(std::size_t row, std::size_t hint) {
  const Row& r = rows_[row];
  const int id = 6 + static_cast<int>(row);
  if (!r.plane && !(r.speed > 1e-300)) return false;
  const double b = right_hand_side(r);
  return (hint != Polytope::none && polytope_.cut(r.n, b, id, hint)) || polytope_.cut(r.n, b, id);
}

void Search::rebuild() {
  t_ = target();
  polytope_ = box();
  for (std::size_t i = 0; i < rows_.size(); ++i) cut(i, Polytope::none);
}

double Search::visit(const Vector<3>& up, const Row* from, std::size_t hint) {
  Evaluation e = evaluate(up, from);
  const bool better = improves(e.V) && inside(up);
  rows_.push_back(e.row);
  if (better) {
    best_V_ = e.V;
    best_up_ = e.row.at;
    best_row_ = e.row;
  }
  if (better && limited_)
    rebuild();
  else
    cut(rows_.size() - 1, hint);
  return e.V;
}

/// Where what can be held has no inside, the planes that leave nothing else are meant to be hit:
/// what is a little beside them is so by rounding.
std::vector<Plane> Search::meant(const Vector<3>& x, const std::array<int, 3>& planes) const {
  std::vector<Plane> hit;
  for (const int id : planes) {
    if (id < 6) continue;
    const Row& row = rows_[static_cast<std::size_t>(id - 6)];
    if (row.holdable) continue;
    const double b = limited_ ? right_hand_side(row) : 0;
    if (std::abs(row.n.dot(x) - b) <= 1e-7) hit.push_back({row.n, b});
  }
  return hit;
}

Vector<3> Search::snapped(const Vector<3>& x, const std::array<int, 3>& planes) const {
  const Vector<3> up = x.normalized();
  return OnPlanes(up, meant(up, planes)).posture(up);
}

const Row* Search::neighbour(const Vector<3>& x, const std::array<int, 3>& planes) const {
  const Row* nearest = nullptr;
  for (const int id : planes) {
    if (id < 6) continue;
    const Row& row = rows_[static_cast<std::size_t>(id - 6)];
    if (row.plane || !row.holdable) continue;
    if (nearest == nullptr || row.at.dot(x) > nearest->at.dot(x)) nearest = &row;
  }
  return nearest;
}

/// A plane for a point of the polytope outside of the domain. True if there was need for one.
bool Search::stay_inside(const Vector<3>& x, const std::array<int, 3>& planes, std::size_t vertex) {
  for (const Cone& cone : cones_) {
    const double excess = cone.excess(x);
    if (!(excess > 1e-12)) continue;
    const Row* from = neighbour(x, planes);
    const Row start = from != nullptr ? *from : Row{};
    Row row;
    row.n = cone.plane(x).normalized();
    row.plane = true;
    rows_.push_back(row);
    if (!cut(rows_.size() - 1, vertex) && vertex != Polytope::none) polytope_[vertex].tried = true;
    if (excess < 1e-2) visit(cone.nearest(x), from != nullptr ? &start : nullptr);
    return true;
  }
  return false;
}

/// Cuts off the farthest vertex outside of the unit ball. False: there is none.
bool Search::shrink() {
  const std::size_t far = polytope_.farthest(false);
  if (far == Polytope::none) return false;
  const double enough = limited_ ? 1 : 1 / target();  // of |x|^2
  if (polytope_[far].square <= enough) return false;
  const Vector<3> x = polytope_[far].x;
  const std::array<int, 3> planes = polytope_[far].planes;
  if (stay_inside(x, planes, far)) return true;
  const Vector<3> up = snapped(x, planes);
  const Row* nearest = neighbour(x, planes);
  const Row start = nearest != nullptr ? *nearest : Row{};
  const Row* from = nearest != nullptr ? &start : nullptr;
  const double before = best_V_;
  const double at_up = visit(up, from, far);
  const bool holdable = at_up < infinity;
  if (limited_ && best_V_ < before) return true;
  const auto there_still = [&] { return polytope_[far].alive && polytope_[far].x == x; };
  const auto cut_by = [&](const Evaluation& e) {
    rows_.push_back(e.row);
    cut(rows_.size() - 1, far);
    return e.V;
  };
  if (there_still() && !rough_ && (holdable || !limited_)) cut_by(evaluate(up, from, true));
  bool beyond = !holdable;  // of all that can be held
  if (there_still() && limited_) {
    // With min_normal a heavier object may need less.
    const double V = cut_by(evaluate(OnPlanes(x, meant(x, planes)).load(), from));
    beyond = !(V < infinity);
    heavier_is_easier_ = V <= at_up;
    if (there_still() && below(V)) {
      heavier_ = Load{x, V};
      return true;
    }
  }
  if (there_still()) polytope_[far].tried = true;
  // Vertices lie outside of what can be held: look from the inside, too.
  beyond_in_a_row_ = beyond ? beyond_in_a_row_ + 1 : 0;
  if (beyond_in_a_row_ < 2) return true;
  if (limited_ && best_V_ < infinity) {
    const Vector<3> near = x + std::ldexp(1, -std::min(beyond_in_a_row_, 40)) * (best_up_ - x);
    const Evaluation e = evaluate(near);
    rows_.push_back(e.row);
    cut(rows_.size() - 1, Polytope::none);
    if (below(e.V)) (near.norm() > 1 ? heavier_ : lighter_) = Load{near, e.V};
  }
  const Vector<3> middle = best_V_ < infinity ? Vector<3>(up + best_up_) : polytope_.middle();
  if (middle.norm() > 1e-3) visit(snapped(middle, planes), nullptr);
  return true;
}

/// A heavier object needs less: the loads that need at most t_, a convex set, must all be heavier.
/// Cuts off the lightest load of the polytope. False: none is lighter than the object.
bool Search::recede() {
  if (polytope_.empty()) return false;
  const Vector<3> x = polytope_.nearest();
  if (x.norm() >= 1) return false;
  if (stay_inside(x, {0, 0, 0}, Polytope::none))
    return polytope_.empty() || polytope_.nearest() != x;
  const double before = best_V_;
  if (x.norm() > 1e-3) visit(x.normalized(), nullptr);
  if (best_V_ < before) return true;
  const auto try_load = [&](const Vector<3>& load) {
    const Evaluation e = evaluate(load);
    rows_.push_back(e.row);
    cut(rows_.size() - 1, Polytope::none);
    if (load.norm() < 1 && below(e.V)) lighter_ = Load{load, e.V};
    return e.V;
  };
  const auto done = [&] {
    return (lighter_ && below(lighter_->V)) || polytope_.empty() || polytope_.nearest() != x;
  };
  // Where it lies outside of what can be held by rounding, it is approached from the inside.
  const double V = try_load(x);
  const Vector<3> inside = heavier_ ? heavier_->x : best_up_;
  for (int k = 1; k <= 40 && !done() && !(V < infinity); ++k)
    try_load(x + std::ldexp(1, -k) * (inside - x));
  return done();
}

/// Between a lighter load and a heavier one that need at most t_ there is a posture that does.
bool Search::cross() {
  const Vector<3> from = lighter_->x, way = heavier_->x - from;
  const double a = way.squaredNorm(), b = from.dot(way), c = 1 - from.squaredNorm();
  const double before = best_V_;
  visit((from + c / (b + std::sqrt(b * b + a * c)) * way).normalized(), nullptr);
  return best_V_ < before;
}

void Search::begin_with(const Search& easier) {
  if (easier.best_V_ < infinity) visit(easier.best_up_, &easier.best_row_);
  for (Row row : easier.rows_) {
    if (!row.plane) {
      const ScaledGrasp<3>& grasp = scenarios_[row.scenario].grasp->scaled();
      dual::Point<3> point(grasp.size);
      dual::evaluate<3, double>(grasp, Wrench<3>::Zero(), row.y, point);
      row.phi = -point.value;
    }
    rows_.push_back(row);
    cut(rows_.size() - 1, Polytope::none);
  }
}

void Search::run() {
  for (const Cone& cone : cones_)
    if (best_V_ == infinity && inside(cone.axis)) visit(cone.axis, nullptr);
  // A contact right under the com carries alone, perhaps in this posture only.
  for (const Scenario& scenario : scenarios_)
    for (const Vector<3>& up : on_one_contact(*scenario.grasp))
      if (inside(up)) visit(up, nullptr);
  if (limited_) {
    const Evaluation none = evaluate(Vector<3>::Zero(), nullptr, true);
    if (none.V < infinity) lighter_ = Load{Vector<3>::Zero(), none.V};
  }
  for (int step = 0; step < 20 * max_holds_ && holds_ < max_holds_; ++step) {
    if ((1 - gap_) * best_V_ <= 1 / shares_) break;  // less holds nothing
    const bool may_be_heavier = heavier_ && below(heavier_->V);
    const bool may_be_lighter = lighter_ && below(lighter_->V);
    // While neither is known it is tried in turns.
    const bool outwards = may_be_heavier || (heavier_is_easier_ && !may_be_lighter);
    heavier_is_easier_ = false;
    const bool goes_on = may_be_heavier && may_be_lighter ? cross()
                         : outwards ? recede() || !(may_be_heavier || proven())
                                    : shrink();
    if (!goes_on) break;
  }
}

/// No load of the object's weight is left: what is left is lighter, or heavier.
bool Search::proven() const {
  return polytope_.empty() || polytope_[polytope_.farthest(true)].square <= 1 ||
         polytope_.nearest().squaredNorm() > 1;
}

/// Forces add up to the weight: W^2 <= V sum share. The cuts may prove more.
double Search::lower_bound() { return std::max(1 / shares_, bound_by_cuts()); }

double Search::bound_by_cuts() {
  // What rounding of vertices may make out, and of y where it is as good as infinitely long.
  constexpr double safe = 1 - 1e-10;
  if (!limited_) {
    const std::size_t far = polytope_.farthest(true);
    return safe / std::max(far == Polytope::none ? 0 : polytope_[far].square, 1e-40);
  }
  if (proven()) return safe * t_;
  double least = 0, most = t_;
  const auto rebuild_for = [&](double t) {
    t_ = t;
    polytope_ = box();
    for (std::size_t i = 0; i < rows_.size(); ++i) cut(i, Polytope::none);
  };
  for (int halving = 0; halving < 40; ++halving) {
    rebuild_for((least + most) / 2);
    (proven() ? least : most) = t_;
  }
  rebuild_for(least);
  return safe * least;
}

std::vector<Cut> Search::certificate(double t) const {
  std::vector<char> needed(6 + rows_.size(), 0);
  for (std::size_t i = 0; i < polytope_.size(); ++i)
    if (polytope_[i].alive)
      for (const int id : polytope_[i].planes) needed[static_cast<std::size_t>(id)] = 1;
  if (polytope_.farthest(true) == Polytope::none) std::fill(needed.begin(), needed.end(), 1);
  std::vector<Cut> cuts;
  for (std::size_t id = 0; id < needed.size(); ++id) {
    if (needed[id] == 0 || (id < 6 && limited_ && t * shares_ > 4)) continue;
    Cut cut;
    Twist<3> y = Twist<3>::Zero();
    if (id < 6) {
      y[static_cast<Eigen::Index>(id / 2)] = (id % 2 == 0 ? 1 : -1) * std::sqrt(t / shares_);
      cut.scenario = heaviest_;
    } else {
      const Row& row = rows_[id - 6];
      if (row.plane) {
        cut.n = row.n;
        cuts.push_back(cut);
        continue;
      }
      cut.scenario = row.scenario;
      y = row.y;
      const double half = t / (2 * std::pow(scenarios_[row.scenario].weight, 2));
      // As long as is best for it; not so long that rounding would count.
      if (!limited_)
        y *= std::min(std::sqrt(half / row.phi), 1e10 * std::max(half, 1e-10) / row.y.norm());
    }
    cut.y = about_origin(*scenarios_[cut.scenario].grasp, y);
    cuts.push_back(cut);
  }
  return cuts;
}

void check(const std::vector<Grasp<3>>& scenarios, const SpatialSettings& settings) {
  if (!(settings.gap > 0) || !(settings.gap < 1))
    throw InvalidGrasp("gap", "must be above 0 and below 1");
  if (settings.max_holds < 1) throw InvalidGrasp("max_holds", "must be at least 1");
  if (settings.starts < 0) throw InvalidGrasp("starts", "must be at least 0");
  if (!(settings.force_cap > 0) || !(settings.force_cap <= 1e9))
    throw InvalidGrasp("force_cap", "must be above 0 and at most 1e9 weights");
  if (settings.tilt) {
    if (!(std::abs(settings.tilt->from.squaredNorm() - 1) <= 1e-6))
      throw InvalidGrasp("tilt.from", "must be a unit vector");
    if (!(settings.tilt->most >= 0) || !(settings.tilt->most <= pi / 2 + 1e-12))
      throw InvalidGrasp("tilt.most", "must be at least 0 and at most 90 degrees");
  }
  if (scenarios.empty()) throw InvalidGrasp("scenarios", "is empty, must hold at least one");
  const auto& first = scenarios.front().contacts();
  for (const Grasp<3>& grasp : scenarios) {
    const auto same = [](const Contact<3>& a, const Contact<3>& b) {
      return a.position == b.position && a.normal == b.normal && a.friction == b.friction &&
             a.torsion == b.torsion && a.share == b.share && a.min_normal == b.min_normal &&
             a.max_normal == b.max_normal && a.finger == b.finger;
    };
    if (!std::equal(first.begin(), first.end(), grasp.contacts().begin(), grasp.contacts().end(),
                    same))
      throw InvalidGrasp("scenarios", "must all have the same contacts");
  }
}

/// With all scenarios' holds. `row`: of the scenario that decides.
SpatialPosture posture(const std::vector<Scenario>& scenarios, const Vector<3>& up,
                       const Row& row) {
  SpatialPosture result;
  result.up = up;
  for (std::size_t s = 0; s < scenarios.size(); ++s) {
    const Grasp<3>& grasp = *scenarios[s].grasp;
    const HoldSettings settings{scenarios[s].cap};
    Hold<3> found = hold(grasp, up, settings);
    // At the border of what can be held rounding may decide.
    if (!found.holdable && s == row.scenario)
      found = hold<3>(grasp, grasp.load(up), about_origin(grasp, row.y), settings);
    result.scenario_efforts.push_back(found.holdable ? found.effort : infinity);
    if (s > 0 && result.scenario_efforts.back() <= result.hold.effort) continue;
    result.hold = found;
    result.scenario = s;
  }
  result.manner = manner(*scenarios[result.scenario].grasp, up, result.hold);
  return result;
}

/// Descends from `up` until it is the best of all postures within a little cone around it.
std::pair<Vector<3>, Row> descend(const std::vector<Scenario>& scenarios,
                                  const std::vector<Cone>& domain, Vector<3> up) {
  constexpr double near = 0.1;
  Row row;
  for (int step = 0; step < 60; ++step) {
    std::vector<Cone> cones = domain;
    cones.push_back({up, near});
    Search local(scenarios, cones, step == 0 ? 1e-3 : 1e-10, 150, true);
    local.run();
    if (!(local.best_V() < infinity)) break;
    const double moved = std::acos(std::clamp(up.dot(local.best_up()), -1.0, 1.0));
    up = local.best_up();
    row = local.best_row();
    if (step > 0 && moved < 0.99 * near) break;
  }
  return {up, row};
}

/// Points spread over the directions at most an angle from an axis, on a spiral.
std::vector<Vector<3>> spiral(int count, const Cone& cone) {
  const Eigen::Matrix<double, 3, 2> across = tangents(cone.axis);
  const double height = 1 - std::cos(cone.most);
  std::vector<Vector<3>> points;
  for (int k = 0; k < count; ++k) {
    const double z = 1 - height * (k + 0.5) / count, r = std::sqrt(1 - z * z);
    const double turn = k * pi * (3 - std::sqrt(5.0));
    points.emplace_back(across * Vector<2>(r * std::cos(turn), r * std::sin(turn)) + z * cone.axis);
  }
  return points;
}

/// The slope of the effort at a posture, along the sphere; none where it cannot be held.
std::optional<Vector<3>> slope(const Scenario& scenario, const Vector<3>& up) {
  const Hold<3> found = hold(*scenario.grasp, up, {scenario.cap});
  if (!found.holdable) return {};
  const Vector<3> v = about_com(*scenario.grasp, found.dual).head<3>();
  return v - up.dot(v) * up;
}

/// A minimum to all its digits, where the effort is smooth: the effort alone tells only half of
/// them, and a finger that carries nothing there would seem to press a little.
Vector<3> settled(const Scenario& scenario, Vector<3> up) {
  constexpr double h = 1e-5;
  std::optional<Vector<3>> here = slope(scenario, up);
  for (int step = 0; step < 5 && here; ++step) {
    const Eigen::Matrix<double, 3, 2> across = tangents(up);
    Eigen::Matrix2d J;
    for (int k = 0; k < 2; ++k) {
      const auto beside = slope(scenario, (up + h * across.col(k)).normalized());
      if (!beside) return up;
      J.col(k) = across.transpose() * (*beside - *here) / h;
    }
    const Vector<2> way = -J.inverse() * (across.transpose() * *here);
    if (!(J.determinant() > 0) || !(J.trace() > 0) || !(way.norm() < 1e-3)) return up;
    const Vector<3> next = (up + across * way).normalized();
    const auto there = slope(scenario, next);
    if (!there || !(there->norm() < 0.5 * here->norm())) return up;
    up = next;
    here = there;
  }
  return up;
}

bool only_max_normal(const std::vector<Grasp<3>>& grasps) {
  bool any = false;
  for (const Contact<3>& contact : grasps.front().contacts()) {
    if (contact.min_normal > 0) return false;
    any = any || std::isfinite(contact.max_normal);
  }
  return any;
}

Grasp<3> without_max_normal(const Grasp<3>& grasp) {
  std::vector<Contact<3>> contacts = grasp.contacts();
  for (Contact<3>& contact : contacts) contact.max_normal = infinity;
  return {grasp.object(), std::move(contacts)};
}

/// Where to descend from: where steps down the slope lead from postures spread over the domain, and
/// no two that are nearly the same.
std::vector<Vector<3>> starts(Search& search, const std::vector<Cone>& domain, int count) {
  const Cone all = domain.empty() ? Cone{Vector<3>::UnitZ(), pi} : domain.front();
  std::vector<std::pair<double, Vector<3>>> low;
  for (const Vector<3>& start : spiral(count, all)) {
    Vector<3> up = OnPlanes(start, search.thin()).posture(start);
    Evaluation here = search.evaluate(up);
    if (!(here.V < infinity)) continue;
    double reach = 0.1;
    for (int step = 0; step < 30 && reach > 3e-3; ++step) {
      const Vector<3> slope = here.row.n - up.dot(here.row.n) * up;
      if (!(slope.norm() > 1e-9)) break;
      Vector<3> next = (up - reach * slope.normalized()).normalized();
      if (!domain.empty()) next = all.nearest(next);
      next = OnPlanes(next, search.thin()).posture(next);
      const Evaluation there = search.evaluate(next, &here.row);
      reach *= there.V < here.V ? 1.3 : 0.5;
      if (!(there.V < here.V)) continue;
      up = next;
      here = there;
    }
    low.emplace_back(here.V, up);
  }
  std::sort(low.begin(), low.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Vector<3>> lowest;
  for (const auto& [V, up] : low)
    if (std::none_of(lowest.begin(), lowest.end(),
                     [&, at = up](const Vector<3>& other) { return (other - at).norm() < 0.03; }))
      lowest.push_back(up);
  return lowest;
}

}  // namespace

const char* to_string(Status status) {
  constexpr const char* names[] = {"optimal", "gap", "unholdable"};
  return names[static_cast<int>(status)];
}

BestSpatialPosture best_posture(const Grasp<3>& grasp, const SpatialSettings& settings) {
  return best_posture(std::vector<Grasp<3>>{grasp}, settings);
}

BestSpatialPosture best_posture(const std::vector<Grasp<3>>& grasps,
                                const SpatialSettings& settings) {
  check(grasps, settings);
  double weight = 0;
  for (const Grasp<3>& grasp : grasps) weight = std::max(weight, grasp.object().weight);
  std::vector<Scenario> scenarios;
  for (const Grasp<3>& grasp : grasps) {
    const double part = grasp.object().weight / weight;
    scenarios.push_back({&grasp, part, std::min(settings.force_cap / part, 1e9)});
  }
  std::vector<Cone> domain;
  if (settings.tilt) domain.push_back({settings.tilt->from.normalized(), settings.tilt->most});

  BestSpatialPosture result;
  Search search(scenarios, domain, settings.gap, settings.max_holds);
  // What is proven without max_normal holds with it. Where the best posture needs no more then,
  // that is all; else it is where to begin.
  std::vector<Grasp<3>> strong;
  std::vector<Scenario> unlimited;
  std::optional<Search> easier;
  if (only_max_normal(grasps)) {
    for (const Grasp<3>& grasp : grasps) strong.push_back(without_max_normal(grasp));
    for (std::size_t s = 0; s < grasps.size(); ++s)
      unlimited.push_back({&strong[s], scenarios[s].weight, scenarios[s].cap});
    easier.emplace(unlimited, domain, settings.gap, settings.max_holds);
    easier->run();
    search.begin_with(*easier);
  }
  const bool proven =
      easier && search.best_V() <= (1 + 0.1 * settings.gap) * easier->best_V() &&
      (easier->best_V() < infinity || easier->lower_bound() > search.cap() * search.cap());
  if (!proven) search.run();
  Search& prover = proven ? *easier : search;
  const double square = weight * weight, bound = prover.lower_bound();
  result.holds = search.holds() + (easier ? easier->holds() : 0);
  result.cuts = prover.certificate(bound);
  result.lower_bound = square * bound;
  if (!(search.best_V() < infinity)) {
    result.status = bound > search.cap() * search.cap() ? Status::unholdable : Status::gap;
    return result;
  }

  std::vector<std::pair<Vector<3>, Row>> found = {{search.best_up(), search.best_row()}};
  for (const Vector<3>& start : starts(search, domain, settings.starts)) {
    const auto minimum = descend(scenarios, domain, start);
    if (std::none_of(found.begin(), found.end(), [&](const auto& other) {
          return (other.first - minimum.first).norm() < 1e-3;
        }))
      found.push_back(minimum);
  }
  for (const auto& [up, row] : found) {
    SpatialPosture minimum = posture(scenarios, up, row);
    std::vector<Vector<3>> sharper;
    // The best is found no better than the gap tells.
    if (settings.starts > 0 && result.minima.empty())
      sharper.push_back(descend(scenarios, domain, up).first);
    if (scenarios.size() == 1 && domain.empty()) sharper.push_back(settled(scenarios.front(), up));
    for (const Scenario& scenario : scenarios)
      for (const Vector<3>& alone : on_one_contact(*scenario.grasp))
        if ((alone - up).norm() < 1e-4 && (domain.empty() || domain.front().excess(alone) <= 0))
          sharper.push_back(alone);
    for (const Vector<3>& other : sharper) {
      SpatialPosture there = posture(scenarios, other, row);
      if (there.hold.holdable && there.effort() <= (1 + 1e-9) * minimum.effort())
        minimum = std::move(there);
    }
    if (minimum.hold.holdable) result.minima.push_back(std::move(minimum));
  }
  if (result.minima.empty()) return result;  // within rounding of the limit of holding
  std::stable_sort(
      result.minima.begin(), result.minima.end(),
      [](const SpatialPosture& a, const SpatialPosture& b) { return a.effort() < b.effort(); });
  result.best = result.minima.front();
  const double effort = result.best->effort();
  result.lower_bound = std::min(result.lower_bound, effort);
  result.relative_gap = (effort - result.lower_bound) / effort;
  result.status = result.relative_gap <= settings.gap ? Status::optimal : Status::gap;
  for (std::size_t i = 0; i < result.minima.size() && !result.pinched; ++i) {
    const SpatialPosture& minimum = result.minima[i];
    if (minimum.manner != Manner::pinched) continue;
    bool interior = true;
    const Eigen::Matrix<double, 3, 2> across = tangents(minimum.up);
    for (int k = 0; k < 8 && interior; ++k) {
      const Vector<3> beside =
          (minimum.up + 1e-6 * (across * Vector<2>(std::cos(k * pi / 4), std::sin(k * pi / 4))))
              .normalized();
      for (const Cone& cone : domain) interior = interior && !(cone.excess(beside) > 0);
      for (const Scenario& scenario : scenarios)
        interior = interior && hold(*scenario.grasp, beside, {scenario.cap}).holdable;
    }
    if (interior) result.pinched = i;
  }
  return result;
}

Eigen::Quaterniond smallest_turn(const Eigen::Quaterniond& orientation, const Vector<3>& up) {
  const Vector<3> now = (orientation.normalized() * up).normalized();
  // From `now` to z: by half the angle, w = cos and the axis times sin.
  const Vector<3> axis = now.cross(Vector<3>::UnitZ());
  const double across = axis.norm(), angle = std::atan2(across, now.z());
  if (!(across > 1e-15))
    return now.z() > 0 ? Eigen::Quaterniond::Identity() : Eigen::Quaterniond(0, 1, 0, 0);
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis / across));
}

}  // namespace poise
