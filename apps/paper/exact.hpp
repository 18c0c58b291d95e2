// What the paper's equations amount to, in closed form: docs/paper.md, "The exact answer".
#pragma once

#include <vector>

#include "apps/paper/disk.hpp"
#include "poise/posture_curve.hpp"

namespace poise::study {

/// Where alpha_5 = alpha_6: the direction from the centre of mass to the point where the upper
/// edges of the friction cones meet [rad].
double theta_b(const HeldDisk& disk);

/// That point itself [m, object frame].
Vector<2> edges_meet(const HeldDisk& disk);

/// V with alpha_5, contact 1 at the edge of its friction cone: the least effort for theta above
/// theta_b. Of the degree 2 in cos and sin alone: c0 + cos2 cos(2 theta) + sin2 sin(2 theta).
Harmonic2 V_5(const HeldDisk& disk);
/// V with alpha_6, contact 2 at the edge: the least effort for theta below theta_b.
Harmonic2 V_6(const HeldDisk& disk);

/// Above 0 where V rises beyond b, 0 where it stays, by closed form; `mu` is the friction of the
/// contact that slips there (1), `other` that of the other. The same with the frictions exchanged
/// says whether V falls before b. Both must be above cot(phi).
double rise_beyond_b(double phi, double mu, double other);

/// The friction of the other contact above which V rises beyond b: the positive root of
/// rise_beyond_b, a quadratic equation. Where it is below cot(phi) there is no such bound.
double least_other_friction(double phi, double mu);

/// A local minimum of V over the closed range |theta| <= pi - phi.
struct Minimum {
  char name;     ///< 'a', 'b', 'c' of the paper
  double theta;  ///< [rad]
  double V;      ///< [N^2]
  double alpha;  ///< the internal force [N]
  Kind kind;
};

/// All of them, for any frictions, in the order of theta: the whole answer as a list of cases.
std::vector<Minimum> minima(const HeldDisk& disk);

}  // namespace poise::study
