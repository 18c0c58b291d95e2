// The contacts that hold an object: checked, scaled and factorised once, then asked many times.
#pragma once

#include <cstddef>
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

/// Contacts, and the fingers that they belong to. Knows nothing of what is held. Immutable.
template <int Dim>
class Hand {
 public:
  /// @param center  the point about which moments are taken in the solver, best the centre of mass
  ///                of what is held [m, object frame]
  /// @param safety  every friction and torsion is divided by it, >= 1
  /// @throws InvalidGrasp where a number is not finite or out of its range, a normal has no length,
  ///         or there are no contacts.
  Hand(std::vector<Contact<Dim>> contacts, const Vector<Dim>& center, double safety = 1);

  /// The contacts with unit normals, friction already divided by the safety factor, fingers named.
  const std::vector<Contact<Dim>>& contacts() const { return contacts_; }
  /// The fingers' labels in the order of their first contact.
  const std::vector<std::string>& fingers() const { return fingers_; }
  /// Index into fingers() of a contact.
  std::size_t finger_of(std::size_t contact) const { return finger_of_[contact]; }
  /// The point that it was made with [m, object frame].
  const Vector<Dim>& center() const { return center_; }
  /// L [m], the distance of the farthest contact from the center.
  double radius() const { return radius_; }

  /// The contacts in the units in which the solver works.
  struct Scaled;
  const Scaled& scaled() const { return *scaled_; }  ///< for the solver

 private:
  std::vector<Contact<Dim>> contacts_;
  std::vector<std::string> fingers_;
  std::vector<std::size_t> finger_of_;
  Vector<Dim> center_;
  double radius_{0};
  std::shared_ptr<const Scaled> scaled_;
};

/// G: stacked contact forces (normal, tangential; contact by contact) to the wrench on the object
/// about the object frame's origin. Size wrench_size x (contact_size * contacts). The paper's
/// equation (4). In space each contact has four columns: forces along the normal and along
/// tangents(normal) [N], and the moment about the normal [N m], which only soft fingers pass on.
template <int Dim>
Eigen::Matrix<double, wrench_size<Dim>, Eigen::Dynamic> grasp_matrix(const Hand<Dim>& hand);

}  // namespace poise
