// Grippers that close on a body, and where they touch it.
#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "gripper/surface.hpp"
#include "poise/adhesion.hpp"

namespace poise {

/// Where a gripper is: its frame in the object frame.
struct Pose {
  Vector<3> position = Vector<3>::Zero();                           ///< [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< of length 1
};

/// What a pad of a parallel jaw makes of the points where it touches.
enum class JawContact {
  pads,    ///< one contact, a pad with these points
  facets,  ///< a point contact of each
};

/// Two pads that face each other, rectangles across the x axis of the gripper's frame at
/// x = -opening / 2 (left) and x = +opening / 2 (right), in the middle of y and z. They close along
/// x.
struct ParallelJaw {
  Pose pose{};
  double opening{0};           ///< [m], > 0
  double width{0}, height{0};  ///< of a pad, along y and z [m], > 0
  double depth{0.001};         ///< how far a pad gives way [m], >= 0
  double friction{0};
  JawContact contact{JawContact::pads};
  double torsion{0};                                          ///< of facets
  int samples{16};                                            ///< rays of a pad
  double max_force{std::numeric_limits<double>::infinity()};  ///< of the drive [N], > 0
};

/// A finger that moves along a ray until it touches, in the gripper's frame.
struct Fingertip {
  Vector<3> origin = Vector<3>::Zero();      ///< [m]
  Vector<3> direction = Vector<3>::UnitX();  ///< of length 1
  std::string finger{};                      ///< label; "" for one of its own
};

/// Fingers of a hand, each of which touches at one point.
struct Fingertips {
  Pose pose{};
  std::vector<Fingertip> rays{};
  double friction{0}, torsion{0};
  double max_force{std::numeric_limits<double>::infinity()};  ///< of each [N]
};

/// Cups that are pushed against the object, all in one direction, until their rims touch.
struct Suction {
  Pose pose{};
  Vector<3> direction = -Vector<3>::UnitZ();  ///< of length 1, gripper frame
  std::vector<Vector<3>> cups{};              ///< the middles of their rims, gripper frame [m]
  double diameter{0};                         ///< of a rim [m], > 0
  double adhesion{0};                         ///< pull of each cup [N], > 0
  double friction{0};
};

using Gripper = std::variant<ParallelJaw, Fingertips, Suction>;

/// A gripper that does not hold the object between its fingers; what() says why.
class MissedGrip : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Where the gripper touches.
///
/// From each pad of a parallel jaw `samples` rays run along x, from the centres of equal cells in
/// rows and columns, as near to squares as the number allows. The pad moves until the first of them
/// meets the surface; it touches where they meet it within `depth` of that. Each pad moves until it
/// touches, even beyond the middle: object or gripper give way.
///
/// Normals are those of the surface, towards the side that the ray comes from turned inwards. A pad
/// is one contact: its normal is their mean, its position the mean of the points where it touches,
/// each of which carries an equal part. Its reach is how far it touches to both sides of that, by
/// these rays and such from the corners of the cells: all of a pad, half its size. Where it touches
/// at one point alone it is a point contact. Of facets each has 1 / samples of the pad as its
/// share, whether or not the others touch.
/// A cup is a pad: its rim, in the plane of the surface where the middle of the cup meets it. Eight
/// points carry equal parts. The centre of pressure may move as far as a square in the rim allows,
/// so that the rim carries a tilting moment; in truth it may move up to 1.41 times as far.
/// @param notes  gets what looks like a mistake, in words: "contacts 0 to 15 meet the surface ..."
/// @throws MissedGrip where a finger misses the object, begins inside it, or is so far away that no
///         digits are left; then also where the object is, and of what size
std::vector<Contact<3>> contacts(const Gripper& gripper, const Surface& surface,
                                 std::vector<std::string>* notes = nullptr);

/// What moves its fingers: one drive closes both pads of a jaw along x, each fingertip has its own.
/// Of suction see pulls().
Mechanism<3> mechanism(const Gripper& gripper);

/// What pulls the object onto a gripper that touches it there, see add_pulls().
std::vector<Pull<3>> pulls(const Gripper& gripper, const std::vector<Contact<3>>& contacts);

}  // namespace poise
