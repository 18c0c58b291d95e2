// Where a finger touches the object, and which forces it can pass on there without slipping.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "poise/wrench.hpp"

namespace poise {

/// A compliant pad on a rigid finger, in space: its normal force N is spread in fixed parts over
/// its points, of which each passes on a tangential force up to mu times its part of N. The centre
/// of pressure may move within the pad, which leaves the friction as it is. docs/theory.md, "Pads".
struct Pad {
  std::vector<Vector<3>> points;       ///< from the contact's position [m], object frame
  std::vector<double> shares;          ///< of N, one a point, > 0, sum 1
  Vector<3> axis = Vector<3>::Zero();  ///< a direction in the pad's plane; any length but 0
  /// How far the centre of pressure may move from the mean of the points, along the axis and across
  /// it [m], >= 0.
  Vector<2> reach = Vector<2>::Zero();

  bool operator==(const Pad&) const = default;  ///< field by field
};

/// A rectangle around the contact's position, `size` along the axis and across it [m], with even
/// pressure: grid x grid equal cells, a point in the middle of each. Errs towards more force, by
/// less than 2 % of the grip for a grid of 4. `normal`: of the contact; the axis is turned into the
/// plane across it.
Pad rectangular_pad(const Vector<2>& size, const Vector<3>& axis, const Vector<3>& normal,
                    int grid = 4);

/// A contact with Coulomb friction: a point, a soft point or a pad.
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
  std::optional<Pad> pad{};  ///< in space only: the contact is a pad, without torsion and share

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
  if constexpr (Dim == 3) visit("pad", &Contact<Dim>::pad);
}

/// Numbers that describe a contact force: normal and tangential, in space normal, two tangential
/// and the moment about the normal.
template <int Dim>
inline constexpr int contact_size = Dim == 2 ? 2 : 4;

/// Two unit vectors a, b in the columns that make (normal, a, b) a right-handed frame.
Eigen::Matrix<double, 3, 2> tangents(const Vector<3>& normal);

}  // namespace poise
