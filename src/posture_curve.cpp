#include "poise/posture_curve.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "dual.hpp"
#include "harmonic.hpp"
#include "optima.hpp"
#include "twist.hpp"

namespace poise {
namespace {

constexpr double pi = 3.14159265358979323846;
/// Postures closer than this [rad] are one: below it lies the rounding of where arcs end.
constexpr double same_angle = 1e-11;
/// Within this [rad] of the limit of holding, rounding may decide: no piece need be found there.
constexpr double undecided = 1e-8;

/// Coefficients of (1, cos theta, sin theta), one row for each component.
template <int Rows>
using Affine = Eigen::Matrix<double, Rows, 3>;

/// g(theta) = a + b cos theta + c sin theta around a posture where it is not negative: how far it
/// stays so on either side, as t = tan(turn / 2).
struct Reach {
  explicit Reach(double theta) : at(theta), cosine(std::cos(theta)), sine(std::sin(theta)) {}

  /// Keeps to where g >= 0. What is nowhere negative but for rounding is no constraint.
  void keep(const Eigen::RowVector3d& g, double rounding) {
    const double least_g = g[0] + rounding;
    if (least_g >= 0 && least_g * least_g >= g[1] * g[1] + g[2] * g[2]) return;
    const double along = g[1] * cosine + g[2] * sine, half = g[2] * cosine - g[1] * sine;
    const double here = std::max(g[0] + along, 0.0), far = g[0] - along;
    // here + 2 half t + far t^2 = 0
    const double square = half * half - here * far;
    if (square < 0) return;
    const double sum = -(half + std::copysign(std::sqrt(square), half));
    const double one = sum / far, other = here / sum;
    for (const double t : {one, other}) {
      if (t > 0) most = std::min(most, t);
      if (t < 0) least = std::max(least, t);
    }
    if (here == 0) (half > 0 ? least : most) = 0;  // but for rounding, only one side is open
  }
  /// Keeps to this side of a posture.
  void stop(double angle) {
    const double t = std::tan(std::remainder(angle - at, 2 * pi) / 2);
    (t < 0 ? least : most) = t < 0 ? std::max(least, t) : std::min(most, t);
  }
  double from() const { return at + 2 * std::atan(least); }
  double to() const { return at + 2 * std::atan(most); }

  double at, cosine, sine;
  double least{-std::numeric_limits<double>::infinity()};
  double most{std::numeric_limits<double>::infinity()};
};

/// One contact along an arc.
struct ContactOnArc {
  Eigen::Matrix<double, 3, 2> G;  ///< its columns of the grasp matrix
  dual::Face face;
  Affine<2> F;  ///< its force
};

class Tracer {
 public:
  Tracer(const Grasp<2>& grasp, const CurveSettings& settings)
      : grasp_(grasp), scaled_(grasp.scaled()), cap_(settings.force_cap), point_(scaled_.size) {
    curve_.domain = domain_interval(grasp, settings.domain);
    contacts_.resize(scaled_.size);
    curve_.arcs.reserve(8);
    curve_.states.reserve(8 * scaled_.size);
    for (std::size_t i = 0; i < scaled_.size; ++i) contacts_[i].G = dual::columns(scaled_, i);
  }

  PostureCurve trace() {
    const Interval& domain = curve_.domain;
    if (domain.to - domain.from < 2 * pi) {
      cover(domain.from, domain.to);
    } else {  // start with the piece around some posture, and go on from its end to its start
      const Interval first = piece_at(0.1, 0.1 - pi, 0.1 + pi);
      cover(first.to, first.from + 2 * pi);
    }
    put_in_order();
    return std::move(curve_);
  }

 private:
  /// Fills an interval with pieces. Each covers the posture at which it is asked for, so that they
  /// end; the posture is off the middle, since symmetric grasps have their kinks there.
  void cover(double from, double to) {
    std::vector<Interval> open;
    open.reserve(16);
    open.push_back({from, to});
    // There are about 4 arcs for each contact; at the limit of holding, where rounding decides,
    // there may be no end of them.
    std::size_t probes = 64 * (scaled_.size + 16), fruitless = 200;
    while (!open.empty() && probes-- > 0) {
      const auto [lo, hi] = open.back();
      open.pop_back();
      if (hi - lo <= same_angle) continue;
      const Interval piece = piece_at(lo + 0.4871 * (hi - lo), lo, hi);
      const bool found = piece.to - piece.from > undecided;
      if (!found && (hi - lo < undecided || fruitless == 0)) continue;
      if (!found) --fruitless;
      open.push_back({lo, piece.from});
      open.push_back({piece.to, hi});
    }
  }

  /// Adds the arc or unholdable arc around a posture, as far as it goes within lo, hi.
  Interval piece_at(double at, double lo, double hi) {
    Reach reach(at);
    const Wrench<2> w(reach.sine, reach.cosine, 0);
    const bool holdable =
        dual::maximise<2>(scaled_, w, dual::cold_start<2>(scaled_, w), cap_, point_);
    Arc arc;
    const bool decided =
        holdable ? arc_at(at, reach, arc) : dual::lower_bound(point_) > cap_ * cap_;
    if (!decided) return {at, at};
    if (!holdable) unholdable_reach(w, reach);
    const Interval piece{std::max(lo, reach.from()), std::min(hi, reach.to())};
    if (!holdable) {
      curve_.unholdable_arcs.push_back({piece.from, piece.to, about_origin(grasp_, point_.y)});
    } else if (piece.to > piece.from) {
      arc.from = piece.from;
      arc.to = piece.to;
      add(arc);
    }
    return piece;
  }

  /// Around a posture where point_.y proves that nothing holds: where else it does.
  void unholdable_reach(const Wrench<2>& w, Reach& reach) {
    Twist<2> y = point_.y;
    const double value = point_.value, bound = dual::lower_bound(point_) - (1 + 1e-6) * cap_ * cap_;
    // A y that proves more the longer it is, proves it up to where gravity no longer drives it; too
    // long, and rounding in G^T y drowns it.
    dual::evaluate<2>(scaled_, w, 1e3 * y, point_);
    const bool ray = point_.value > 500 * value;
    if (ray) y *= std::clamp(1e19 / y.norm(), 1.0, 1e8);
    dual::evaluate<2>(scaled_, w, y, point_);
    double limits = 0;  // what contacts at their limits add to phi; of a ray the rest is rounding
    for (std::size_t i = 0; i < scaled_.size; ++i) {
      const dual::Face face = dual::face(scaled_, i, point_.z(i));
      if (face.at_lo || face.at_hi) limits += point_.z(i).dot(point_.f(i));
    }
    const Eigen::RowVector3d g(ray ? -limits : bound / 2 - y.dot(w), y[1], y[0]);
    reach.keep(g, 0);
    // It may prove all postures but one.
    const double size = std::hypot(g[1], g[2]);
    if (std::abs(g[0] - size) <= 1e-9 * size) reach.stop(std::atan2(-g[2], -g[1]));
  }

  /// The arc around a posture, from the faces to which point_ projects. False where they do not
  /// balance the neighbouring postures: the posture is an arc of its own.
  bool arc_at(double at, Reach& reach, Arc& arc) {
    Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < scaled_.size; ++i) {
      ContactOnArc& contact = contacts_[i];
      contact.face = dual::face(scaled_, i, point_.z(i));
      M += contact.G * contact.face.P * contact.G.transpose();
    }
    // A turn about the com that no contact feels has no say in the forces (2 x 2 is left of M).
    const bool free_turn = M(2, 2) <= 1e-26 * M.trace();
    if (free_turn) {
      M.row(2).setZero();
      M.col(2).setZero();
      M(2, 2) = M.trace();
    }
    const Eigen::Vector3d scale = M.diagonal().cwiseSqrt().cwiseInverse();
    if (!scale.allFinite()) return false;
    const Eigen::Matrix3d scaled = scale.asDiagonal() * M * scale.asDiagonal();
    const double pivot = 1 - scaled(0, 1) * scaled(0, 1);
    if (!(pivot > 1e-14) || !(scaled.determinant() > 1e-14 * pivot)) return false;
    const Eigen::Matrix3d inverse = scale.asDiagonal() * scaled.inverse() * scale.asDiagonal();

    // y and the forces, refined in the forces: see dual.cpp, polish.
    Affine<3> Y = Affine<3>::Zero(), residual;
    residual << 0, 0, 1, 0, 1, 0, 0, 0, 0;  // w
    for (ContactOnArc& contact : contacts_) {
      contact.F.setZero();
      contact.F.col(0) = contact.face.f0;
      residual.col(0) -= contact.G * contact.face.f0;
    }
    double largest_force = 1;
    for (int round = 0; round < 4; ++round) {
      if (free_turn) residual.row(2).setZero();
      if (residual.cwiseAbs().maxCoeff() <= 4e-15 * largest_force) break;
      const Affine<3> dY = inverse * residual;
      Y += dY;
      residual << 0, 0, 1, 0, 1, 0, 0, 0, 0;
      for (std::size_t i = 0; i < scaled_.size; ++i) {
        ContactOnArc& contact = contacts_[i];
        const dual::Face& face = contact.face;
        contact.F += face.P * (contact.G.transpose() * dY);
        // Exactly on the edge: what rounding adds beside it would be taken for a balance.
        if (face.edge) contact.F.row(1) = face.sign * mu(i) * contact.F.row(0);
        residual -= contact.G * contact.F;
        largest_force = std::max(largest_force, contact.F.cwiseAbs().maxCoeff());
      }
    }
    if (free_turn) Y.row(2) = turn_at(at, Y);

    const double weight = grasp_.object().weight;
    const double rounding_f = 1e-12 * largest_force, rounding_y = 1e-12 * Y.cwiseAbs().maxCoeff();
    arc.V = {};
    for (std::size_t i = 0; i < scaled_.size; ++i) {
      for_each_condition(i, Y, [&](const Eigen::RowVector3d& g, bool of_force) {
        reach.keep(g, of_force ? rounding_f : rounding_y);
      });
      const Affine<2>& F = contacts_[i].F;
      for (int k = 0; k < 2; ++k) {
        const double a = F(k, 0), b = F(k, 1), c = F(k, 2), square = weight * weight;
        arc.V.c0 += square * (a * a + (b * b + c * c) / 2);
        arc.V.cos1 += square * 2 * a * b;
        arc.V.sin1 += square * 2 * a * c;
        arc.V.cos2 += square * (b * b - c * c) / 2;
        arc.V.sin2 += square * b * c;
      }
    }
    for (int k = 0; k < 3; ++k) {
      const Twist<2> y = about_origin(grasp_, Y.col(k));
      for (std::size_t row = 0; row < 3; ++row) {
        Harmonic1& h = arc.y[row];
        (k == 0 ? h.c0 : k == 1 ? h.cos1 : h.sin1) = y[static_cast<int>(row)];
      }
    }
    keep_below_cap(at, arc.V, reach);
    return true;
  }

  /// Calls f(g, of_force) for each g(theta) >= 0 that keeps contact i on its face: that the force
  /// stays on it, and that z stays over it.
  template <class Function>
  void for_each_condition(std::size_t i, const Affine<3>& Y, const Function& f) const {
    const ContactLane<2>& c = scaled_.lanes[i / lane_size];
    const std::size_t k = i % lane_size;
    const double mu = c.mu[k], lo = c.lo[k], hi = c.hi[k];
    const auto& [G, face, F] = contacts_[i];
    const bool free = !face.at_lo && !face.at_hi;
    using Row = Eigen::RowVector3d;
    const Row one(1, 0, 0);
    const Affine<2> Z = G.transpose() * Y;
    const Row n = F.row(0), t = F.row(1), zn = Z.row(0), side = face.sign * Z.row(1);
    const Row along = face.edge ? Row((zn + mu * side) * c.edge[k]) : zn;
    if (face.edge && face.at_lo && lo == 0) {  // the apex
      f(-along, false);
      if (mu > 0) f(mu * side - zn, false);
      return;
    }
    if (face.at_lo) f(lo * one - along, false);
    if (face.at_hi) f(along - hi * one, false);
    if (free && (face.edge || lo > 0)) f(n - lo * one, true);
    if (free && std::isfinite(hi)) f(hi * one - n, true);
    if (face.edge && mu > 0) f(side - mu * (free ? zn : n), false);
    if (!face.edge) {
      f(mu * n - t, true);
      f(mu * n + t, true);
    }
  }

  /// The angular velocity that no loaded contact feels: 0, or what the others allow at `at`, at the
  /// end of their range.
  Eigen::RowVector3d turn_at(double at, const Affine<3>& Y) const {
    const Eigen::Vector3d here(1, std::cos(at), std::sin(at));
    Affine<3> turn = Affine<3>::Zero();
    turn(2, 0) = 1;
    double least = -std::numeric_limits<double>::infinity(), most = -least;
    Eigen::RowVector3d at_least(0, 0, 0), at_most(0, 0, 0);
    Affine<3> still = Y;
    still.row(2).setZero();
    for (std::size_t i = 0; i < scaled_.size; ++i) {
      std::vector<Eigen::RowVector3d> base, both;  // conditions at angular velocity 0 and 1
      for_each_condition(i, still, [&](const auto& g, bool of_force) {
        if (!of_force) base.push_back(g);
      });
      for_each_condition(i, still + turn, [&](const auto& g, bool of_force) {
        if (!of_force) both.push_back(g);
      });
      for (std::size_t k = 0; k < base.size(); ++k) {
        const double rate = both[k][0] - base[k][0];
        if (std::abs(rate) <= 1e-12) continue;
        const Eigen::RowVector3d end = -base[k] / rate;
        const double omega = end.dot(here);
        if (rate > 0 && omega > least) {
          least = omega;
          at_least = end;
        } else if (rate < 0 && omega < most) {
          most = omega;
          at_most = end;
        }
      }
    }
    if (least > 0) return at_least;
    if (most < 0) return at_most;
    return {0, 0, 0};
  }

  /// Ends the arc where its effort leaves the force cap.
  void keep_below_cap(double at, const Harmonic2& V, Reach& reach) const {
    const double cap = cap_ * grasp_.object().weight;
    const double most = V.c0 + std::hypot(V.cos1, V.sin1) + std::hypot(V.cos2, V.sin2);
    if (most <= cap * cap) return;
    Harmonic2 below = V;
    below.c0 -= cap * cap;
    for (const double end : sign_changes(below, at - pi, at + pi)) reach.stop(end);
  }

  double mu(std::size_t i) const { return scaled_.lanes[i / lane_size].mu[i % lane_size]; }

  void add(Arc& arc) {
    arc.first_state = curve_.states.size();
    const auto vanishes = [](const Eigen::RowVector3d& g) {
      return g.cwiseAbs().maxCoeff() <= 1e-9;
    };
    for (std::size_t i = 0; i < scaled_.size; ++i) {
      const auto& [G, face, F] = contacts_[i];
      const std::size_t k = i % lane_size;
      const ContactLane<2>& c = scaled_.lanes[i / lane_size];
      const Eigen::RowVector3d n = F.row(0), t = F.row(1), most = c.mu[k] * n;
      const auto at = [&](double limit) {
        return std::isfinite(limit) && vanishes(n - Eigen::RowVector3d(limit, 0, 0));
      };
      const bool slips = face.edge || vanishes(most - t) || vanishes(most + t);
      curve_.states.push_back({vanishes(n) ? ContactState::unloaded
                               : slips     ? ContactState::slipping
                                           : ContactState::sticking,
                               at(c.hi[k])                  ? ForceLimit::max
                               : c.lo[k] > 0 && at(c.lo[k]) ? ForceLimit::min
                                                            : ForceLimit::none});
    }
    curve_.arcs.push_back(arc);
  }

  /// A posture that holds although its neighbours do not.
  bool add_point(double at) {
    const Hold<2> held = hold(grasp_, up_at(at), {cap_});
    if (!held.holdable) return false;
    Arc arc;
    arc.from = arc.to = at;
    arc.V.c0 = held.effort;
    for (std::size_t k = 0; k < 3; ++k) arc.y[k].c0 = held.dual[static_cast<int>(k)];
    arc.first_state = curve_.states.size();
    for (const ContactForce<2>& force : held.forces)
      curve_.states.push_back({force.state, force.limit});
    curve_.arcs.push_back(arc);
    return true;
  }

  void put_in_order() {
    const bool circle = curve_.domain.to - curve_.domain.from >= 2 * pi;
    const double start = curve_.domain.from;
    const auto order = [&](auto& pieces) {
      for (auto& piece : pieces) {
        const double turns = circle ? 2 * pi * std::floor((piece.from - start) / (2 * pi)) : 0;
        piece.from -= turns;
        piece.to -= turns;
      }
      std::sort(pieces.begin(), pieces.end(),
                [](const auto& a, const auto& b) { return a.from < b.from; });
    };
    order(curve_.unholdable_arcs);
    add_points(circle);
    order(curve_.arcs);
    drop_slivers();
    join_arcs(circle);
    find_undecided(circle);
  }

  /// What of the domain is in no piece.
  void find_undecided(bool circle) {
    std::vector<Interval> pieces;
    for (const Arc& arc : curve_.arcs) pieces.push_back({arc.from, arc.to});
    for (const UnholdableArc& gap : curve_.unholdable_arcs) pieces.push_back({gap.from, gap.to});
    std::sort(pieces.begin(), pieces.end(),
              [](const Interval& a, const Interval& b) { return a.from < b.from; });
    double reached = curve_.domain.from, end = curve_.domain.to;
    if (circle && !pieces.empty()) {  // once around from the first piece to itself
      reached = pieces.front().from;
      end = reached + 2 * pi;
    }
    pieces.push_back({end, end});
    for (const Interval& piece : pieces) {
      if (piece.from - reached > undecided) curve_.undecided.push_back({reached, piece.from});
      reached = std::max(reached, piece.to);
    }
  }

  /// Where an arc gives way to unholdable postures, rounding may find slivers in between.
  void drop_slivers() {
    const auto near = [](double a, double b) {
      return std::abs(std::remainder(a - b, 2 * pi)) <= undecided;
    };
    const auto is_sliver = [](const Arc& arc) { return arc.to - arc.from <= undecided; };
    const auto between = [&](const Arc& arc) {
      const auto beside = [&](const auto& piece) {
        return near(piece.from, arc.to) || near(piece.to, arc.from);
      };
      return std::any_of(curve_.unholdable_arcs.begin(), curve_.unholdable_arcs.end(), beside) &&
             std::any_of(curve_.arcs.begin(), curve_.arcs.end(),
                         [&](const Arc& other) { return !is_sliver(other) && beside(other); });
    };
    std::vector<std::size_t> slivers;
    for (std::size_t i = curve_.arcs.size(); i-- > 0;)
      if (is_sliver(curve_.arcs[i]) && between(curve_.arcs[i])) slivers.push_back(i);
    for (const std::size_t i : slivers)
      curve_.arcs.erase(curve_.arcs.begin() + static_cast<std::ptrdiff_t>(i));
  }

  /// Single postures hold, if any, where unholdable arcs meet or the domain ends.
  void add_points(bool circle) {
    auto& gaps = curve_.unholdable_arcs;
    const std::size_t n = gaps.size();
    for (std::size_t i = 0; i < n; ++i) {
      const double from = gaps[i].from, to = gaps[i].to;
      if (!circle && from - curve_.domain.from <= same_angle) add_point(curve_.domain.from);
      const double next = i + 1 < n ? gaps[i + 1].from
                          : circle  ? gaps[0].from + 2 * pi
                                    : curve_.domain.to;
      if (next - to > undecided) continue;
      if (i + 1 == n && !circle) {
        add_point(curve_.domain.to);
      } else if (!add_point(to) && next != to) {
        add_point(next);
      }
    }
  }

  bool gap_between(double from, double to) const {
    return std::any_of(curve_.unholdable_arcs.begin(), curve_.unholdable_arcs.end(),
                       [&](const UnholdableArc& gap) {
                         return gap.from < to && gap.to > from && gap.to - gap.from > same_angle;
                       });
  }

  /// Neighbouring arcs end at one posture; what is closer than same_angle touches.
  void join_arcs(bool circle) {
    auto& arcs = curve_.arcs;
    auto& holdable = curve_.holdable;
    for (Arc& arc : arcs) {
      const bool joins = !holdable.empty() && arc.from - holdable.back().to <= undecided &&
                         !gap_between(holdable.back().to, arc.from);
      if (joins) {
        arc.from = holdable.back().to;
        arc.to = std::max(arc.from, arc.to);
        holdable.back().to = arc.to;
      } else {
        holdable.push_back({arc.from, arc.to});
      }
    }
    if (!circle || holdable.empty()) return;
    Interval& first = holdable.front();
    Interval& last = holdable.back();
    if (first.from + 2 * pi - last.to > undecided) return;
    arcs.back().to = first.from + 2 * pi;  // the last arc runs into the first
    if (holdable.size() == 1) {
      first = {-pi, pi};
    } else {
      last.to = first.to + 2 * pi;
      holdable.erase(holdable.begin());
    }
  }

  const Grasp<2>& grasp_;
  const ScaledGrasp<2>& scaled_;
  double cap_;
  dual::Point<2> point_;
  std::vector<ContactOnArc> contacts_;
  PostureCurve curve_;
};

}  // namespace

const char* to_string(Kind kind) {
  constexpr const char* names[] = {"boundary", "kink", "smooth"};
  return names[static_cast<int>(kind)];
}

Interval domain_interval(const Grasp<2>& grasp, Domain domain) {
  if (domain == Domain::all) return {-pi, pi};
  const Interval wedge = cradled_wedge(grasp);
  if (!(wedge.to > wedge.from)) return {-pi, pi};
  return wedge.to < pi ? Interval{wedge.to, wedge.from + 2 * pi}
                       : Interval{wedge.to - 2 * pi, wedge.from};
}

PostureCurve posture_curve(const Grasp<2>& grasp, const CurveSettings& settings) {
  PostureCurve curve = Tracer(grasp, settings).trace();
  curve.optima = optima(curve);
  for (Interval& interval : curve.holdable) {
    const double turns = 2 * pi * std::floor((interval.from + pi) / (2 * pi));
    interval.from -= turns;
    interval.to -= turns;
  }
  return curve;
}

}  // namespace poise
