#include "plane/tracer.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <optional>

#include "dual/dual.hpp"
#include "dual/twist.hpp"
#include "plane/arc.hpp"
#include "plane/cover.hpp"
#include "plane/harmonic.hpp"

namespace poise {
namespace {

using std::numbers::pi;

class Tracer {
 public:
  Tracer(const Grasp<2>& grasp, const Interval& domain, double force_cap)
      : problem_(grasp.scaled(), grasp.size()),
        load_(load_curve(problem_.hand, problem_.weight, grasp.loads().front())),
        cap_(force_cap),
        point_(problem_.size),
        solver_(problem_, load_) {
    curve_.domain = domain;
    curve_.arcs.reserve(8);
    curve_.states.reserve(8 * problem_.size);
  }

  PostureCurve trace() {
    const Interval& domain = curve_.domain;
    const auto piece = [&](double at, double lo, double hi) { return piece_at(at, lo, hi); };
    if (domain.to - domain.from < 2 * pi)
      cover(domain.from, domain.to, problem_.size, piece);
    else
      cover_circle(problem_.size, piece);
    return std::move(curve_);
  }

 private:
  /// Adds the arc or unholdable arc around a posture, as far as it goes within lo, hi.
  Interval piece_at(double at, double lo, double hi) {
    Reach reach(at);
    const Wrench<2> w = load_ * Vector<3>(1, reach.cosine, reach.sine);
    const bool holdable =
        dual::maximise<2>(problem_, w, dual::cold_start(problem_, w), cap_, point_);
    if (!holdable) {
      if (!(dual::lower_bound(point_) > cap_ * cap_)) return {at, at};
      unholdable_reach(w, reach);
      const Interval piece = within(reach, lo, hi);
      curve_.unholdable_arcs.push_back(
          {piece.from, piece.to, about_origin(problem_.hand, problem_.weight, point_.y)});
      return piece;
    }
    Arc& arc = curve_.arcs.emplace_back();
    Interval piece{at, at};
    if (arc_at(w, reach, arc)) piece = within(reach, lo, hi);
    if (piece.to > piece.from) {
      arc.from = piece.from;
      arc.to = piece.to;
    } else {
      curve_.states.resize(arc.first_state);
      curve_.arcs.pop_back();
    }
    return piece;
  }

  static Interval within(const Reach& reach, double lo, double hi) {
    return {std::max(lo, reach.from()), std::min(hi, reach.to())};
  }

  /// Around a posture where point_.y proves that nothing holds: where else it does.
  void unholdable_reach(const Wrench<2>& w, Reach& reach) {
    double limits = 0;
    bool ray = make_ray(limits);
    if (!ray) {  // in truth, or by rounding
      const dual::Point<2> narrow = point_;
      dual::decide<2>(in_wide_numbers().cones, w, cap_, wide_->point);
      dual::evaluate<2, double>(problem_, w, wide_->point.y.cast<double>(), point_);
      if (!(dual::lower_bound(point_) > cap_ * cap_)) point_ = narrow;
      ray = make_ray(limits);
    }
    const Twist<2>& y = point_.y;
    const double bound = dual::lower_bound(point_) - (1 + 1e-6) * cap_ * cap_;
    const Eigen::RowVector3d drive = y.transpose() * load_;  // y . w(theta)
    const double here = drive.dot(Eigen::RowVector3d(0, reach.cosine, reach.sine));
    const Eigen::RowVector3d g(ray ? drive[0] - limits : bound / 2 - here, drive[1], drive[2]);
    reach.keep(g, 0);
    // It may prove all postures but one.
    const double size = std::hypot(g[1], g[2]);
    if (std::abs(g[0] - size) <= 1e-9 * size) reach.stop(std::atan2(-g[2], -g[1]));
  }

  /// Whether the y of point_ proves more the longer it is, up to where gravity no longer drives it.
  /// Then it is made so long that contacts which do not press by more than rounding show, and
  /// `limits` is what those at a limit of their force add to phi.
  bool make_ray(double& limits) {
    const Twist<2> y = point_.y * std::clamp(1e19 / point_.y.norm(), 1.0, 1e8);
    dual::Point<2> far(problem_.size);
    dual::evaluate<2, double>(problem_, Wrench<2>::Zero(), y, far);
    limits = 0;
    for (std::size_t i = 0; i < problem_.size; ++i) {
      const dual::Face<> face = dual::face<double>(problem_, i, far.z(i));
      if (face.at_lo || face.at_hi) limits += far.z(i).dot(far.f(i));
    }
    const double rounding = 2e-15 * y.norm();
    if (-far.value - limits > rounding * rounding * static_cast<double>(problem_.size))
      return false;
    point_ = far;
    return true;
  }

  /// The arc around a posture that holds, and its states.
  bool arc_at(const Wrench<2>& w, Reach& reach, Arc& arc) {
    arc.first_state = curve_.states.size();
    const auto solve_with = [&](auto& solver, const auto& point) {
      if (!solver.solve(point, reach, arc)) return false;
      for (std::size_t i = 0; i < problem_.size; ++i) curve_.states.push_back(solver.state(i));
      return true;
    };
    if (!solve_with(solver_, point_)) {  // nearly degenerate faces
      dual::decide<2>(in_wide_numbers().cones, w, cap_, wide_->point);
      if (!solve_with(wide_->solver, wide_->point)) return false;
    }
    const double weight = problem_.weight, square = weight * weight;
    for (double* c :
         {&arc.value.c0, &arc.value.cos1, &arc.value.sin1, &arc.value.cos2, &arc.value.sin2})
      *c *= square;
    std::array<Harmonic1, 3>& y = arc.y;
    const auto to_origin = [&](double Harmonic1::*c) {
      const Twist<2> at = about_origin(problem_.hand, problem_.weight, {y[0].*c, y[1].*c, y[2].*c});
      for (std::size_t row = 0; row < 3; ++row) y[row].*c = at[static_cast<int>(row)];
    };
    for (double Harmonic1::*c : {&Harmonic1::c0, &Harmonic1::cos1, &Harmonic1::sin1}) to_origin(c);
    keep_below_cap(reach.at, arc.value, reach);
    return true;
  }

  /// Ends the arc where its effort leaves the force cap.
  void keep_below_cap(double at, const Harmonic2& V, Reach& reach) const {
    const double cap = cap_ * problem_.weight;
    const double most =
        V.c0 + std::abs(V.cos1) + std::abs(V.sin1) + std::abs(V.cos2) + std::abs(V.sin2);
    if (most <= cap * cap) return;
    Harmonic2 below = V;
    below.c0 -= cap * cap;
    for (const Root& end : sign_changes(below, at - pi, at + pi)) reach.stop(end.at);
  }

  dual::Problem<2> problem_;
  LoadCurve load_;
  double cap_;
  dual::Point<2> point_;
  ArcSolver<double> solver_;
  struct InWideNumbers {
    InWideNumbers(const Cones<2>& narrow, const LoadCurve& load)
        : widened(narrow), cones(widened.cones()), point(cones.size), solver(cones, load) {}
    Widened<2> widened;
    Cones<2, Wide> cones;
    dual::Point<2, Wide> point;
    ArcSolver<Wide> solver;
  };
  InWideNumbers& in_wide_numbers() { return wide_ ? *wide_ : wide_.emplace(problem_, load_); }
  std::optional<InWideNumbers> wide_;  // made where rounding asks for it
  PostureCurve curve_;
};

}  // namespace

PostureCurve trace(const Grasp<2>& grasp, const Interval& domain, double force_cap) {
  return Tracer(grasp, domain, force_cap).trace();
}

}  // namespace poise
