// The contacts that hold an object: checked, scaled and factorised once, then asked many times.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "poise/contact.hpp"

namespace poise {

/// A grasp or a question that has no meaning: which field is wrong, and what would be right.
class InvalidGrasp : public std::invalid_argument {
 public:
  /// what() is "path: problem".
  InvalidGrasp(const std::string& path, const std::string& problem)
      : std::invalid_argument(path + ": " + problem), path_(path), problem_(problem) {}
  const std::string& path() const noexcept { return path_; }        ///< "contacts[1].friction"
  const std::string& problem() const noexcept { return problem_; }  ///< "is -1, must be at least 0"

 private:
  std::string path_, problem_;
};

/// What is said of a finger beside its contacts.
template <int Dim>
struct Finger {
  std::string name;  ///< the label of its contacts
  /// The direction in which it pushes, object frame, any length. Zero: the mean of the inward
  /// normals of its contacts by their shares.
  Vector<Dim> closing = Vector<Dim>::Zero();
  /// Of its pressing force, where drives are not listed [N], > 0; the least of coupled fingers
  /// limits their drive.
  double max_force{std::numeric_limits<double>::infinity()};

  bool operator==(const Finger&) const = default;  ///< field by field
};

/// What moves fingers against the object. Its effort is the power of their forces on the object per
/// unit of its speed: of a jaw the pressing force, of a joint the torque. docs/theory.md, "Drives".
template <int Dim>
struct Drive {
  /// A finger that it moves.
  struct Moved {
    std::string finger;
    Twist<Dim> twist;  ///< per unit of the drive's speed, about the object frame's origin

    bool operator==(const Moved&) const = default;  ///< field by field
  };
  std::string name;
  std::vector<Moved> moves;
  double max{std::numeric_limits<double>::infinity()};  ///< greatest effort [N, or N m], > 0
  bool turns{false};  ///< its speed is in rad/s, its effort in N m

  bool operator==(const Drive&) const = default;  ///< field by field
};

/// How the fingers are driven.
enum class DriveKind {
  each,     ///< each finger by a drive of its own, along its closing direction
  coupled,  ///< all fingers by one drive, each with an equal part of its speed
  listed,   ///< by the drives of a list; other fingers are fixed
};
/// The name of the value: "coupled".
const char* to_string(DriveKind kind);

/// What moves the fingers of a hand.
template <int Dim>
struct Mechanism {
  DriveKind kind{DriveKind::each};
  std::vector<Finger<Dim>> fingers;  ///< those of which something is said
  std::vector<Drive<Dim>> drives;    ///< of a list

  bool operator==(const Mechanism&) const = default;  ///< field by field
};

/// Contacts, and the fingers that they belong to. Knows nothing of what is held. Immutable.
template <int Dim>
class Hand {
 public:
  /// @param center  the point about which moments are taken in the solver, best the centre of mass
  ///                of what is held [m, object frame]
  /// @param safety  every friction and torsion is divided by it, >= 1
  /// @param mechanism  how the fingers are driven
  /// @throws InvalidGrasp where a number is not finite or out of its range, a normal has no length,
  ///         there are no contacts, or a drive moves a finger that there is not.
  Hand(std::vector<Contact<Dim>> contacts, const Vector<Dim>& center, double safety = 1,
       Mechanism<Dim> mechanism = {});

  /// The contacts with unit normals, friction already divided by the safety factor, fingers named.
  const std::vector<Contact<Dim>>& contacts() const { return contacts_; }
  /// The fingers' labels in the order of their first contact.
  const std::vector<std::string>& fingers() const { return fingers_; }
  /// Index into fingers() of a contact.
  std::size_t finger_of(std::size_t contact) const { return finger_of_[contact]; }
  /// The closing direction of a finger, a unit vector: as it was given, or the mean of the inward
  /// normals of its contacts by their shares; zero where that is shorter than 0.1.
  Vector<Dim> closing(std::size_t finger) const;
  /// How the fingers are driven, as it was given.
  const Mechanism<Dim>& mechanism() const { return mechanism_; }
  /// The drives, with the twists of the fingers that they move; those of fingers without a closing
  /// direction are zero. Made anew by each call.
  std::vector<Drive<Dim>> drives() const;
  /// Whether forces are limited by drives, or by pads: then the solver is another.
  bool is_general() const { return is_general_; }
  /// The point that it was made with [m, object frame].
  const Vector<Dim>& center() const { return center_; }
  /// L [m], the distance of the farthest contact, or point of a pad, from the center.
  double radius() const { return radius_; }
  /// The unit of lengths: L, or 1 m where all contacts lie at the center.
  double length() const;

  /// The contacts in the units in which the solver works.
  struct Scaled;
  const Scaled& scaled() const { return *scaled_; }  ///< for the solver

  /// What the drives move, with everything looked up.
  struct Driven;
  const Driven& driven() const { return *driven_; }  ///< for the solver

 private:
  void check_mechanism();

  std::vector<Contact<Dim>> contacts_;
  std::vector<std::string> fingers_;
  std::vector<std::size_t> finger_of_;
  Mechanism<Dim> mechanism_;
  bool is_general_{false};
  Vector<Dim> center_;
  double radius_{0};
  std::shared_ptr<const Scaled> scaled_;
  std::shared_ptr<const Driven> driven_;
};

/// G: stacked contact forces (normal, tangential; contact by contact) to the wrench on the object
/// about the object frame's origin. Size wrench_size x (contact_size * contacts). The paper's
/// equation (4). In space each contact has four columns: forces along the normal and along
/// tangents(normal) [N], and the moment about the normal [N m], which only soft fingers pass on.
template <int Dim>
Eigen::Matrix<double, wrench_size<Dim>, Eigen::Dynamic> grasp_matrix(const Hand<Dim>& hand);

}  // namespace poise
