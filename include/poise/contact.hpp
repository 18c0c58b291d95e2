// Where a finger touches the object, and which forces it can pass on there without slipping.
#pragma once

#include <limits>
#include <string>

#include "poise/wrench.hpp"

namespace poise {

/// A contact with Coulomb friction.
///
/// The force of the finger on the object is given in the contact frame: the normal force along the
/// inward normal n, and the tangential force, in the plane one number along n turned by +90
/// degrees. A soft finger also passes on a moment m about n: (|t| / mu)^2 + (m / gamma)^2 <= n^2,
/// and in the effort m counts as the force m mu / gamma.
template <int Dim>
struct Contact {
  Vector<Dim> position = Vector<Dim>::Zero();  ///< [m], object frame
  Vector<Dim> normal = Vector<Dim>::Zero();  ///< from the finger into the object; any length but 0
  double friction{0};                        ///< coefficient mu >= 0; 0 is a frictionless contact
  double min_normal{0};                      ///< least normal force [N], >= 0
  double max_normal{std::numeric_limits<double>::infinity()};  ///< greatest normal force [N]
  /// The part of a pad that this contact stands for, in (0, 1]: its force counts as |f|^2 / share.
  double share{1};
  // "", since {} makes g++ 12 crash on grasps written as nested braces.
  std::string finger = "";  ///< label; left empty, the contact is a finger of its own
  /// gamma [m], >= 0, in space only: above 0 the finger is soft. Needs friction, and is at most
  /// 1e12 times friction times the radius of the grasp.
  double torsion{0};

  bool operator==(const Contact&) const = default;  ///< field by field
};

/// The fields of a contact, each with the name that files, documents and Python have for it: calls
/// visit(name, pointer to member) for one after the other. Readers, writers and bindings go by this
/// list, so that a new field stands here alone.
template <int Dim, class Visit>
void for_each_contact_field(const Visit& visit) {
  visit("position", &Contact<Dim>::position);
  visit("normal", &Contact<Dim>::normal);
  visit("friction", &Contact<Dim>::friction);
  if constexpr (Dim == 3) visit("torsion", &Contact<Dim>::torsion);
  visit("min_normal", &Contact<Dim>::min_normal);
  visit("max_normal", &Contact<Dim>::max_normal);
  visit("share", &Contact<Dim>::share);
  visit("finger", &Contact<Dim>::finger);
}

/// Numbers that describe a contact force: normal and tangential, in space normal, two tangential
/// and the moment about the normal.
template <int Dim>
inline constexpr int contact_size = Dim == 2 ? 2 : 4;

/// Two unit vectors a, b in the columns that make (normal, a, b) a right-handed frame.
Eigen::Matrix<double, 3, 2> tangents(const Vector<3>& normal);

}  // namespace poise
