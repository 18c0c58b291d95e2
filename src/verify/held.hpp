// The grasp and the mathematics by which results are checked, written out plainly, in the plane and
// in space alike: docs/certificate.md. Nothing here knows how results are found.
#pragma once

#include <string>
#include <vector>

#include "poise/grasp.hpp"
#include "verify/claims.hpp"

namespace poise::verify {

using Vec = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using Mat = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

/// Balance within this counts as balance: force / W and moment / (W L).
inline constexpr Real delta = 1e-12L;

/// A force that a contact passes on: along the normal, then along the tangents, and for a soft
/// finger its moment about the normal, times friction / torsion.
struct Touch {
  std::string finger;
  Vec position, normal;  ///< the normal points inwards and has length 1
  Real friction{0}, lo{0}, hi{0}, share{1};
  Real torsion{0};  ///< [m], 0 for a hard finger
  Mat G;            ///< the wrench of such a force, about the origin
};

/// The load in one scenario.
struct Load {
  Real weight{0};
  Vec com;
  Real radius{0};  ///< L, the distance of the farthest contact from the com
};

/// Object and contacts.
struct Held {
  int dim{2};
  std::vector<Load> loads;
  std::vector<Touch> contacts;
  std::vector<std::string> fingers;  ///< in the order of their first contact

  int wrench_size() const { return dim == 2 ? 3 : 6; }
  Real heaviest() const;
};

/// The same contacts with all frictions and torsions multiplied by a factor.
Held with_friction(Held held, Real factor);

Held held(const Grasp<2>& grasp);
/// One for each scenario: the same contacts.
Held held(const std::vector<Grasp<3>>& scenarios);

/// The wrench of a force at a point, about the origin.
Vec wrench(const Vec& force, const Vec& point);
/// The wrench that the contacts must supply: the weight, upwards through the com.
Vec wrench(const Load& load, const Vec& up);
/// The velocity of a point under the twist y, and the length of its angular velocity.
Vec velocity(const Vec& y, const Vec& point);
Real turning(const Vec& y);

/// How far a force is outside of its friction cone and limits.
Real outside(const Touch& contact, const Vec& force);
/// The nearest point to z of the friction cone, cut at its limits.
Vec project(const Touch& contact, const Vec& z);
/// The force that maximises z . f - |f|^2 / (2 share), and that maximum.
Vec response(const Touch& contact, const Vec& z);
Real phi(const Touch& contact, const Vec& z);
Real phi(const Held& held, const Vec& y);
/// 2 (y . w - phi(G^T y)): no forces that balance w have less effort.
Real bound(const Held& held, const Vec& w, const Vec& y);
/// |v| + L |omega| times the weight, v at the com: what an error of the balance of 1 is worth to y.
Real worth(const Load& load, const Vec& y);
/// The same bound for forces that balance w within delta.
Real proven(const Held& held, const Load& load, const Vec& w, const Vec& y);

/// weight * gain <= fixed for every weight that is held in a posture with a force norm of at most
/// `cap` weights, balanced within delta.
struct WeightBound {
  Real gain{0}, fixed{0};
};
WeightBound weight_bound(const Held& held, const Load& load, const Vec& up, const Vec& y, Real cap);

}  // namespace poise::verify
