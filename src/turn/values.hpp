// The values of postures and what they say of the postures between: docs/theory.md, "The turn".
// Not installed.
#pragma once

#include <vector>

#include "poise/turn.hpp"
#include "space/oracle.hpp"

namespace poise::turns {

using search::HalfSpace;
using search::infinity;

/// What needs no more [p, in the unit of the oracle] needs nothing: less is rounding.
inline constexpr double nothing = 1e-6;

/// A posture, or another x.
struct Valued {
  Vector<3> x = Vector<3>::Zero();
  double p{infinity};    ///< the root of the value, in the unit of the oracle
  HalfSpace half_space;  ///< by which it shows

  bool holdable() const { return p < infinity; }
};

/// Part of a great circle.
struct Arc {
  Vector<3> from, across;  ///< unit vectors
  double angle;            ///< [rad]

  Vector<3> at(double t) const { return std::cos(t) * from + std::sin(t) * across; }
};
/// The shorter one between two unit vectors; of opposite ones that through `beside`.
Arc arc_between(const Vector<3>& from, const Vector<3>& to, const Vector<3>& beside);
Arc arc_between(const Vector<3>& from, const Vector<3>& to);

/// p(x), the root of the greatest effort of the loads or their greatest grip. It is convex, and a
/// gauge where nothing is fixed or limited.
class Values {
 public:
  Values(const Grasp<3>& grasp, const TurnSettings& settings);

  Valued at(const Vector<3>& x);
  /// The same for a posture, which may lie outside of the domain.
  Valued in_domain(const Vector<3>& up);
  /// No posture on the arc between two, nor in the triangle with the point where its tangents meet,
  /// has a higher p.
  double most_between(const Valued& a, const Valued& b);
  /// What a half-space proves of p all along the shorter arc between two postures, or all over a
  /// triangle of them.
  double least_between(const HalfSpace& half_space, const Vector<3>& a, const Vector<3>& b) const;
  double least_within(const HalfSpace& half_space, const Vector<3>& a, const Vector<3>& b,
                      const Vector<3>& c) const;

  double value(double p) const;       ///< V [N^2] or F
  double gap_of_p(double gap) const;  ///< of the value
  int holds() const { return oracle_.holds; }
  Cut cut(const HalfSpace& half_space, double p) const { return oracle_.cut(half_space, p * p); }
  /// With the holds of all loads.
  Posture<3> posture(const Vector<3>& up) const;
  /// The same for one that is unholdable, to show why.
  Posture<3> unholdable(const Vector<3>& up) const {
    return posture_at(grasp_, up, {settings_.force_cap, settings_.objective});
  }
  const search::Oracle& oracle() const { return oracle_; }
  bool is_in_domain(const Vector<3>& up) const { return outside(up) <= 1e-9; }
  /// From now on all postures are in the domain.
  void forget_domain() { domain_.reset(); }

 private:
  double outside(const Vector<3>& up) const { return domain_ ? domain_->excess(up) : -1; }

  const Grasp<3>& grasp_;
  TurnSettings settings_;
  std::vector<search::ScaledLoad> loads_;
  search::Oracle oracle_;
  std::optional<search::TiltCone> domain_;
};

/// @throws InvalidGrasp where it is none
void check_unit(const char* name, const Vector<3>& up);

}  // namespace poise::turns
