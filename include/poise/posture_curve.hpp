// The least effort or grip over all planar postures, exactly: docs/theory.md, "The posture curve"
// and "The grip curve".
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "poise/posture.hpp"

namespace poise {

/// c0 + cos1 cos(theta) + sin1 sin(theta)
struct Harmonic1 {
  double c0{0}, cos1{0}, sin1{0};
  /// The value at theta [rad].
  double operator()(double theta) const {
    return c0 + cos1 * std::cos(theta) + sin1 * std::sin(theta);
  }
};

/// Harmonic1 + cos2 cos(2 theta) + sin2 sin(2 theta)
struct Harmonic2 {
  double c0{0}, cos1{0}, sin1{0}, cos2{0}, sin2{0};
  /// The value at theta [rad].
  double operator()(double theta) const { return at(std::cos(theta), std::sin(theta)); }
  /// The derivative at theta [rad].
  double slope(double theta) const { return slope_at(std::cos(theta), std::sin(theta)); }
  /// The value, from the cosine and sine of theta.
  double at(double c, double s) const {
    return c0 + cos1 * c + sin1 * s + cos2 * (c * c - s * s) + sin2 * 2 * s * c;
  }
  /// The derivative, from the cosine and sine of theta.
  double slope_at(double c, double s) const {
    return sin1 * c - cos1 * s + 2 * (sin2 * (c * c - s * s) - cos2 * 2 * s * c);
  }
};

/// What one contact does all along an arc.
struct ArcState {
  ContactState state;
  ForceLimit limit;
};

/// The force of one contact all along an arc, in the contact frame [N].
struct ArcForce {
  Harmonic1 normal, tangential;
};

/// Postures in which every contact keeps its part of the friction cone. Of effort: the forces and y
/// are affine in (cos theta, sin theta), and V is a trigonometric polynomial of degree 2. Of grip:
/// y and the rates are the same all along, the forces are affine, and F is y . w.
struct Arc {
  double from{0}, to{0};       ///< [rad], closed
  Harmonic2 value;             ///< V [N^2], or F [grip_unit()], of degree 1
  std::array<Harmonic1, 3> y;  ///< optimal dual, about the object frame's origin; see Hold::dual
  /// First index into PostureCurve::states; the arc has one state for each contact from there on.
  std::size_t first_state{0};
  std::optional<std::vector<double>> rates{};  ///< of the drives, of grip
  /// Of grip: forces that balance the load all along at a grip of F, one for each contact. They are
  /// not those of least effort.
  std::vector<ArcForce> forces{};
  std::size_t load{0};  ///< that needs most here
};

/// Postures in which the object cannot be held, and one y that proves it inside (see Hold::dual),
/// up to about 1e-8 rad from ends where the object can be held; with rates where it is the drives'
/// max that forbids it.
struct UnholdableArc {
  double from{0}, to{0};  ///< [rad], open
  Twist<2> y;
  std::optional<std::vector<double>> rates{};
  std::size_t load{0};  ///< that cannot be held
};

/// Of an optimum of the curve.
enum class Kind {
  boundary,  ///< an end of the domain or of the holdable set
  kink,      ///< the curve has a corner
  smooth,
};
/// The name of the value: "kink".
const char* to_string(Kind kind);

/// A local minimum or maximum of the curve over the domain's holdable postures.
struct Optimum {
  double angle{
      0};  ///< [rad], in (-pi, pi]; of a stretch of equal values the nearest to the present
  double from{0}, to{0};  ///< the stretch; both are `angle` where the optimum is one posture
  double value{0};        ///< V [N^2], or F [grip_unit()]
  Kind kind{Kind::smooth};
  bool maximum{false};
};

/// The whole answer in the plane. Angles of arcs run from the domain's start upwards. Of several
/// loads it is that of the load that needs most in each posture.
struct PostureCurve {
  Objective objective{Objective::effort};  ///< what the values are of
  Interval domain;
  std::vector<Arc> arcs;
  std::vector<ArcState> states;  ///< of all arcs, contact by contact; see Arc::first_state
  std::vector<UnholdableArc> unholdable_arcs;
  std::vector<Interval> holdable;  ///< closed; a single posture is [x, x]
  /// Where rounding left more than 1e-8 rad undecided: neither an arc nor proven unholdable. Empty
  /// unless the grasp is nearly degenerate. Angles as in `arcs`.
  std::vector<Interval> undecided;
  /// Minima by value, lowest first, then maxima, highest first. Of ties (within 1e-6) the
  /// least turn from the present posture, then that counter-clockwise.
  std::vector<Optimum> optima;
  /// Of several loads the curve of each alone, over the same domain: what proves that the others
  /// need no more. Empty where there is one.
  std::vector<PostureCurve> loads{};
};

/// Planar postures to choose from: all of them, or the paper's range of pinching up: those outside
/// the fork of the fingers, see fork_wedge().
enum class Domain { all, pinching_up };

/// Which postures to go through, and what still counts as a hold.
struct CurveSettings {
  Domain domain{Domain::all};
  double force_cap{1e6};                   ///< in sizes of each load
  Objective objective{Objective::effort};  ///< what is to be least
  double present{0};                       ///< [rad]: of ties the least turn from it comes first
};

/// The postures to choose from: the whole circle, or the closed rest of the fork of the first load.
Interval domain_interval(const Grasp<2>& grasp, Domain domain);

/// V(theta) or F*(theta) of every posture of the domain, with its minima and maxima, without
/// sampling; of several loads their greatest.
/// @throws InvalidGrasp of effort where a drive has a max; of grip as grip_unit()
PostureCurve posture_curve(const Grasp<2>& grasp, const CurveSettings& settings = {});

}  // namespace poise
