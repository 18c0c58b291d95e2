#include "space/posture_search.hpp"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "dual/newton.hpp"
#include "dual/twist.hpp"


namespace poise::search {

Case::Case(const ScaledHand<3>& hand, const Load<3>& load, double heaviest, double force_cap)
    : problem(hand, load.weight),
      arm((load.com - hand.center) * hand.per_length),
      fixed(scaled_wrench(hand, load.weight, load.fixed)),
      weight(load.weight / heaviest),
      cap(std::min(force_cap / weight, 1e9)) {}

std::vector<Vector<3>> on_one_contact(const Grasp<3>& grasp) {
  std::vector<Vector<3>> ups;
  for (const Load<3>& load : grasp.loads())
    for (const Contact<3>& contact : grasp.contacts()) {
      const Vector<3> arm = load.com - contact.position;
      const bool at_com = arm.norm() <= 1e-9 * grasp.radius();
      const Vector<3> along = at_com ? contact.normal : Vector<3>(arm.normalized());
      const double normal = contact.normal.dot(along);
      const double beside = (along - normal * contact.normal).norm();
      if (beside <= contact.friction * std::abs(normal) + 1e-9)
        ups.push_back(normal > 0 ? along : -along);
    }
  return ups;
}

Search::Search(const Grasp<3>& grasp, const std::vector<Case>& cases, std::vector<Cone> cones,
               double gap, int max_holds, bool rough)
    : grasp_(grasp),
      cases_(cases),
      cones_(std::move(cones)),
      gap_(gap),
      max_holds_(max_holds),
      rough_(rough) {
  bool fixed = false;
  for (const Case& each : cases) {
    fixed = fixed || !each.fixed.isZero(0);
    cap_ = std::max(cap_, each.cap * each.weight);
  }
  limited_ = fixed || cases.front().problem.limited;
  for (const Contact<3>& contact : grasp.contacts()) shares_ += contact.share;
  // |f| >= W / sqrt(sum share), by y = t e_k, where forces add up to the weight.
  if (!fixed) least_ = 1 / shares_;
  for (std::size_t s = 0; s < cases.size(); ++s)
    if (cases[s].weight == 1) heaviest_ = s;
  t_ = limited_ ? target() : 1;
  polytope_ = box();
  for (std::size_t s = 0; s < cases.size(); ++s)
    for (const Twist<3>& unfelt : cases[s].problem.hand.unfelt) {
      const Vector<3> v = cases[s].velocity(unfelt);
      if (!(v.norm() > 1e-9)) continue;
      if (cases[s].fixed.isZero(0)) thin_.push_back({v.normalized(), 0});
      for (const double sign : {1.0, -1.0}) nothing_resists(s, sign * unfelt);
    }
}

Polytope Search::box() const {
  const double half = least_ > 0 ? std::sqrt(t_ * shares_) : infinity;
  return Polytope(limited_ ? std::min(half, 2.0) : half);
}

double Search::target() const {
  return std::min((1 - gap_) * (1 + 1e-3 * gap_) * best_V_, 1.01 * cap_ * cap_);
}

bool Search::inside(const Vector<3>& up) const {
  return std::all_of(cones_.begin(), cones_.end(),
                     [&](const Cone& cone) { return cone.excess(up) <= 1e-9; });
}

namespace {

/// phi(G^T y), and what rounding of G^T y may hide of it: a cut must not be deeper than it is.
double felt(const dual::Point<3>& point, bool limited) {
  double power = 0, squared = 0, contacts = 0;
  for (const dual::LaneForces<3, double>& lane : point.lanes) {
    Lane zf{}, ff{};
    for (int k = 0; k < contact_size<3>; ++k) {
      zf += lane.z[k] * lane.f[k];
      ff += lane.f[k] * lane.f[k];
    }
    power += sum(zf);
    squared += sum(ff);
    contacts += lane_size;
  }
  const double rounding = 1e-15 * std::sqrt(contacts) * dual::l1_norm(point.y);
  const double phi = limited ? power - squared / 2 : squared / 2;
  return phi + rounding * (std::sqrt(squared) + rounding / 2);
}

}  // namespace

Row Search::row(const dual::Point<3>& point, std::size_t load, const Vector<3>& at,
                bool holdable) const {
  const Vector<3> v = cases_[load].velocity(point.y);
  Row row;
  row.y = point.y;
  row.speed = v.norm();
  row.n = v / row.speed;
  row.phi = felt(point, limited_) - point.y.dot(cases_[load].fixed);
  row.load = load;
  row.at = at;
  row.holdable = holdable;
  return row;
}

namespace {

/// Newton steps until what the dual may still gain is little beside what it adds to `known`, a
/// bound on the effort. True where it then shows that w needs at least `least`; else `start` is
/// where to go on from.
bool probe(const dual::Problem<3>& problem, const Wrench<3>& w, double known, double least,
           Twist<3>& start, dual::Point<3>& point) {
  // A very long y is of no use for other loads, and no start.
  const auto too_long = [&](const Twist<3>& y) { return !(dual::l1_norm(y) < 1e4 * (1 + known)); };
  if (too_long(start)) start = dual::cold_start(problem, w);
  dual::evaluate<3, double>(problem, w, Twist<3>(start), point);
  for (int step = 0; step < 6; ++step) {
    const dual::Square<3, double> M = dual::curvature<3, double>(problem, point);
    const Twist<3> dy = dual::newton_step(M, point.residual);
    const double gain = point.residual.dot(dy), before = point.value;
    start = point.y;
    if (!(dual::l1_norm(dy) < 3 * (1 + dual::l1_norm(start)))) return false;
    dual::evaluate<3, double>(problem, w, Twist<3>(start + dy), point);
    if (!(point.value >= before + 0.1 * gain) || too_long(point.y)) return false;
    start = point.y;
    if (2 * point.value < least) {
      // It may be the best yet.
      if (gain < 1e-3 * (least - 2 * point.value)) return false;
      continue;
    }
    const double left = point.residual.dot(dual::newton_step(M, point.residual));
    if (left <= 0.1 * (2 * point.value - known)) return true;
  }
  return false;
}

}  // namespace

Evaluation Search::evaluate(const Vector<3>& given, const Row* from, bool exact, double known) {
  Vector<3> x = given;
  const auto hits = [&](const Plane& plane) { return std::abs(plane.n.dot(given)) < 1e-6; };
  if (!thin_.empty() && given.norm() > 1e-3 && std::all_of(thin_.begin(), thin_.end(), hits))
    x = OnPlanes(given, thin_).load().normalized() * given.norm();
  if (inside(given) && !inside(x)) x = given;
  Evaluation worst;
  worst.V = -1;
  for (std::size_t s = 0; s < cases_.size(); ++s) {
    const Case& load = cases_[s];
    const dual::Problem<3>& problem = load.problem;
    const Wrench<3> w = load.at(x);
    dual::Point<3> point(problem.size);
    Twist<3> start = from != nullptr && from->load == s ? from->y : dual::cold_start(problem, w);
    const double in_units = load.weight * load.weight;
    if (known > 0 && probe(problem, w, known / in_units, best_V_ / in_units, start, point)) {
      ++holds_;
      return {2 * in_units * point.value, row(point, s, x, true)};
    }
    bool holdable = !exact && dual::approach(problem, w, start, load.cap, point);
    double square = dual::squared_norm(point);
    // Where the two disagree again and again, beside what can be held, the first is not believed.
    if (holdable && !exact && !rough_ && improves(in_units * square) && refuted_ > 20) {
      holdable = false;
    } else if (exact || (!rough_ && holdable && improves(in_units * square) &&
                         point.residual.cwiseAbs().maxCoeff() > 0.5 * dual::delta)) {
      dual::Point<3> rough = point;
      const bool approached = holdable;
      holdable = dual::maximise(problem, w, exact ? start : Twist<3>(point.y), load.cap, point);
      square = dual::squared_norm(point);
      if (approached && !holdable) ++refuted_;
      // Rounding of a load may ask for a very long y, of no use for other loads.
      if (approached && holdable && dual::l1_norm(point.y) > 1e3 * dual::l1_norm(rough.y)) point = rough;
    }
    ++holds_;
    const double V = holdable ? in_units * square : infinity;
    if (!(V > worst.V)) continue;
    worst.V = V;
    // Where nothing holds, y is a direction: farther along it may cut deeper, and so may less far
    // where y is so long that its rounding counts.
    if (limited_ && !holdable) {
      const double half = t_ / (2 * in_units);
      const auto depth = [&](const Twist<3>& y, double phi) {
        return (y.dot(w) - phi - half) / y.cwiseAbs().sum();
      };
      const Twist<3> found = point.y;
      Twist<3> best = found;
      double least = felt(point, true);
      for (double times = 1e3; times > 1e-13; times *= 1e-3) {
        dual::evaluate<3, double>(problem, w, Twist<3>(times * found), point);
        const double phi = felt(point, limited_);
        if (!(depth(point.y, phi) > depth(best, least))) continue;
        best = point.y;
        least = phi;
      }
      dual::evaluate<3, double>(problem, w, best, point);
    }
    worst.row = row(point, s, x, holdable);
    if (!holdable) break;
  }
  return worst;
}

/// A row for a twist that no contact feels.
void Search::nothing_resists(std::size_t load, const Twist<3>& y) {
  const dual::Problem<3>& problem = cases_[load].problem;
  dual::Point<3> point(problem.size);
  dual::evaluate<3, double>(problem, Wrench<3>::Zero(), Twist<3>(1e8 * y), point);
  rows_.push_back(row(point, load, Vector<3>::Zero(), false));
  cut(rows_.size() - 1, Polytope::none);
}

/// Without limits y may be as long as is best for a cut; not so long that rounding would count,
/// also where y is told about an origin far from the center.
double Search::stretch(const Row& row, double half) const {
  const ScaledHand<3>& hand = cases_[row.load].problem.hand;
  const double arm = 1 + hand.center.norm() * hand.per_length;
  return std::sqrt(half) * std::min(1 / std::sqrt(row.phi), 1e13 / (arm * row.y.norm()));
}

/// Of n . x where the effort is at most t_.
double Search::right_hand_side(const Row& row) const {
  if (row.plane) return 0;
  const double weight = cases_[row.load].weight, half = t_ / (2 * weight * weight);
  const double times = limited_ ? 1 : stretch(row, half), most = half / times + times * row.phi;
  return (most + (dual::delta + 1e-15) * dual::dual_norm<3, double>(row.y)) / row.speed;
}

bool Search::cut(std::size_t row, std::size_t hint) {
  const Row& r = rows_[row];
  const int id = 6 + static_cast<int>(row);
  if (!r.plane && !(r.speed > 1e-300)) return false;
  const double b = right_hand_side(r);
  return (hint != Polytope::none && polytope_.cut(r.n, b, id, hint)) || polytope_.cut(r.n, b, id);
}

void Search::rebuild(double t) {
  t_ = t;
  polytope_ = box();
  for (std::size_t i = 0; i < rows_.size(); ++i) cut(i, Polytope::none);
}

double Search::visit(const Vector<3>& up, const Row* from, std::size_t hint, double known) {
  Evaluation e = evaluate(up, from, false, known);
  const bool better = improves(e.V) && inside(up);
  rows_.push_back(e.row);
  if (better) {
    best_V_ = e.V;
    best_up_ = e.row.at;
    best_row_ = e.row;
  }
  if (better && limited_)
    rebuild(target());
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

/// Where to start from at a vertex: between the y of its three planes, for while no contact changes
/// its face y is linear; else at the nearest.
std::optional<Row> Search::beside(const Vector<3>& x, const std::array<int, 3>& planes) const {
  const Row* nearest = neighbour(x, planes);
  if (nearest == nullptr) return {};
  Row start = *nearest;
  Eigen::Matrix3d at;
  std::array<const Row*, 3> rows{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (planes[k] < 6) return start;
    rows[k] = &rows_[static_cast<std::size_t>(planes[k] - 6)];
    if (rows[k]->plane || !rows[k]->holdable || rows[k]->load != start.load) return start;
    at.col(static_cast<Eigen::Index>(k)) = rows[k]->at;
  }
  const Vector<3> part = at.inverse() * x.normalized();
  if (!(part.minCoeff() > -0.5) || !(part.maxCoeff() < 2)) return start;
  start.y.setZero();
  for (std::size_t k = 0; k < 3; ++k) start.y += part[static_cast<Eigen::Index>(k)] * rows[k]->y;
  return start;
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
    if (!cut(rows_.size() - 1, vertex) && vertex != Polytope::none) {
      if (excess < 1e-9) continue;  // by rounding
      polytope_.pass_over(vertex);
    }
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
  const std::optional<Row> start = beside(x, planes);
  const Row* from = start ? &*start : nullptr;
  const double before = best_V_;
  const double at_up = visit(up, from, far, limited_ ? 0 : 1 / polytope_[far].square);
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
      heavier_ = Known{x, V};
      return true;
    }
  }
  if (there_still()) polytope_.pass_over(far);
  // Vertices lie outside of what can be held: look from the inside, too, as near to its border as
  // there are holds.
  beyond_in_a_row_ = beyond ? beyond_in_a_row_ + 1 : 0;
  if (beyond_in_a_row_ < 2) return true;
  const Vector<3> inside = best_V_ < infinity ? best_up_ : polytope_.middle();
  const double part = std::ldexp(1, -nearness_);
  bool holds = false;
  if (limited_) {
    const Vector<3> near = x + part * (inside - x);
    const Evaluation e = evaluate(near);
    rows_.push_back(e.row);
    cut(rows_.size() - 1, Polytope::none);
    holds = e.V < infinity;
    if (below(e.V)) (near.norm() > 1 ? heavier_ : lighter_) = Known{near, e.V};
  }
  const Vector<3> near = best_V_ < infinity ? Vector<3>(up + part * (best_up_ - up)) : inside;
  if (near.norm() > 1e-3 && visit(snapped(near, planes), nullptr) < infinity) holds = true;
  nearness_ = std::clamp(nearness_ + (holds ? 1 : -1), 1, 40);
  return true;
}

namespace {

/// On the way from a lighter load to a heavier one, the posture in which the load is the weight.
Vector<3> of_the_weight(const Vector<3>& lighter, const Vector<3>& heavier) {
  const Vector<3> way = heavier - lighter;
  const double a = way.squaredNorm(), b = lighter.dot(way), c = 1 - lighter.squaredNorm();
  return (lighter + c / (b + std::sqrt(b * b + a * c)) * way).normalized();
}

}  // namespace

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
    if (load.norm() < 1 && below(e.V)) lighter_ = Known{load, e.V};
    return e.V;
  };
  const auto done = [&] {
    return (lighter_ && below(lighter_->V)) || polytope_.empty() || polytope_.nearest() != x;
  };
  const double V = try_load(x);
  // It lies outside of what can be held, a known load inside: between them are postures, too.
  if (heavier_ && !(V < infinity)) {
    const Vector<3> up = of_the_weight(x, heavier_->x);
    visit(up, nullptr);
    if (best_V_ < before) return true;
    const Vector<3> middle = (up + heavier_->x) / 2;
    const double there = try_load(middle);
    if (middle.norm() > 1 && below(there)) heavier_ = Known{middle, there};
  }
  // Where it lies outside by rounding, it is approached from the inside.
  const Vector<3> inside = heavier_ ? heavier_->x : best_up_;
  for (int k = 1; k <= 40 && !done() && !(V < infinity); ++k)
    try_load(x + std::ldexp(1, -k) * (inside - x));
  return done();
}

/// Between a lighter load and a heavier one that need at most t_ there is a posture that does.
bool Search::cross() {
  const double before = best_V_;
  visit(of_the_weight(lighter_->x, heavier_->x), nullptr);
  return best_V_ < before;
}

void Search::begin_with(const Search& easier) {
  if (easier.best_V_ < infinity) visit(easier.best_up_, &easier.best_row_);
  for (Row row : easier.rows_) {
    if (!row.plane) {
      const Case& load = cases_[row.load];
      dual::Point<3> point(load.problem.size);
      dual::evaluate<3, double>(load.problem, Wrench<3>::Zero(), row.y, point);
      row.phi = felt(point, limited_) - row.y.dot(load.fixed);
    }
    rows_.push_back(row);
    cut(rows_.size() - 1, Polytope::none);
  }
}

void Search::run() {
  for (const Cone& cone : cones_)
    if (best_V_ == infinity && inside(cone.axis)) visit(cone.axis, nullptr);
  // A contact right under the com carries alone, perhaps in this posture only.
  for (const Vector<3>& up : on_one_contact(grasp_))
    if (inside(up)) visit(up, nullptr);
  if (limited_) {
    const Evaluation none = evaluate(Vector<3>::Zero(), nullptr, true);
    if (none.V < infinity) lighter_ = Known{Vector<3>::Zero(), none.V};
  }
  for (int step = 0; step < 20 * max_holds_ && holds_ < max_holds_; ++step) {
    if ((1 - gap_) * best_V_ <= least_) break;  // less holds nothing
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
double Search::lower_bound() { return std::max(least_, bound_by_cuts()); }

double Search::bound_by_cuts() {
  // What rounding of vertices may make out, and of y where it is as good as infinitely long.
  constexpr double safe = 1 - 1e-10;
  if (!limited_) {
    const std::size_t far = polytope_.farthest(true);
    return safe / std::max(far == Polytope::none ? 0 : polytope_[far].square, 1e-40);
  }
  if (proven()) return safe * t_;
  const auto proves = [&](double t) {
    rebuild(t);
    return proven();
  };
  // Down from the target in longer and longer steps, then between the last two.
  const double from = t_;
  double most = from, least = from;
  for (double step = gap_; least == most || !proves(least); step *= 4) {
    most = least;
    least = step < 0.5 ? from * (1 - step) : least / 4;
    if (least <= least_ || least < 1e-300) break;
  }
  if (least > least_) {
    for (int halving = 0; halving < 8; ++halving) {
      const double middle = std::sqrt(least * most);
      (proves(middle) ? least : most) = middle;
    }
  }
  proves(least);
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
    if (needed[id] == 0 || (id < 6 && limited_ && (least_ == 0 || t * shares_ > 4))) continue;
    Cut cut;
    Twist<3> y = Twist<3>::Zero();
    if (id < 6) {
      y[static_cast<Eigen::Index>(id / 2)] = (id % 2 == 0 ? 1 : -1) * std::sqrt(t / shares_);
      cut.load = heaviest_;
    } else {
      const Row& row = rows_[id - 6];
      if (row.plane) {
        cut.n = row.n;
        cuts.push_back(cut);
        continue;
      }
      cut.load = row.load;
      y = row.y;
      const double half = t / (2 * std::pow(cases_[row.load].weight, 2));
      if (!limited_) y *= stretch(row, half);
    }
    const dual::Problem<3>& problem = cases_[cut.load].problem;
    cut.y = about_origin(problem.hand, problem.weight, y);
    cuts.push_back(cut);
  }
  return cuts;
}

}  // namespace poise::search
