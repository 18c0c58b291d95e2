// An object and the contacts that hold it: checked once, then asked many times.
#pragma once

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "poise/contact.hpp"

namespace poise {

/// A grasp that has no meaning: which field is wrong, and what would be right.
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

/// The grasp in the units in which it is solved: src/scaled_grasp.hpp.
template <int Dim>
struct ScaledGrasp;

/// An object and its contacts, checked and prepared. Immutable.
template <int Dim>
class Grasp {
 public:
  /// @param safety  every friction and torsion is divided by it, >= 1
  /// @throws InvalidGrasp where a number is not finite or out of its range, a normal has no length,
  ///         or there are no contacts.
  Grasp(const Object<Dim>& object, std::vector<Contact<Dim>> contacts, double safety = 1);

  /// What is held.
  const Object<Dim>& object() const { return object_; }
  /// The contacts with unit normals, friction already divided by the safety factor, fingers named.
  const std::vector<Contact<Dim>>& contacts() const { return contacts_; }
  /// The fingers' labels in the order of their first contact.
  const std::vector<std::string>& fingers() const { return fingers_; }
  /// Index into fingers() of a contact.
  std::size_t finger_of(std::size_t contact) const { return finger_of_[contact]; }
  /// L [m], the distance of the farthest contact from the centre of mass.
  double radius() const { return radius_; }
  /// The wrench that the contacts must supply in the posture `up` (unit vector, object frame):
  /// weight * up through the centre of mass, about the origin. [N, N m]
  Wrench<Dim> load(const Vector<Dim>& up) const;
  /// For the solver.
  const ScaledGrasp<Dim>& scaled() const { return *scaled_; }

 private:
  Object<Dim> object_;
  std::vector<Contact<Dim>> contacts_;
  std::vector<std::string> fingers_;
  std::vector<std::size_t> finger_of_;
  double radius_{0};
  std::shared_ptr<const ScaledGrasp<Dim>> scaled_;
};

/// G: stacked contact forces (normal, tangential; contact by contact) to the wrench on the object
/// about the object frame's origin. Size wrench_size x (contact_size * contacts). The paper's
/// equation (4). In space each contact has four columns: forces along the normal and along
/// tangents(normal) [N], and the moment about the normal [N m], which only soft fingers pass on.
template <int Dim>
Eigen::Matrix<double, wrench_size<Dim>, Eigen::Dynamic> grasp_matrix(const Grasp<Dim>& grasp);

}  // namespace poise
