// A grasp as people write it down: docs/grasp-file.md.
#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "files/file_error.hpp"
#include "gripper/gripper.hpp"
#include "poise/best_posture.hpp"
#include "shape/shape.hpp"

namespace poise {

/// What grasp files of the plane and of space have in common. All in SI units and in the object
/// frame; normals point inwards.
template <int Dim>
struct CommonFile {
  std::string name{};
  double safety{1};
  std::optional<ShapeOf<Dim>> shape{};
  std::vector<Load<Dim>> loads{};  ///< at least one
  std::vector<Contact<Dim>> contacts{};
  Mechanism<Dim> mechanism{};
  /// A file that says nothing asks for the grip, if its grasp has one.
  Objective objective{Objective::grip};
  /// What is allowed but looks like a mistake: whole lines, "FILE:LINE:COLUMN: path: words".
  std::vector<std::string> warnings{};

  /// @throws InvalidGrasp
  Grasp<Dim> grasp() const { return {loads, contacts, safety, mechanism}; }
};

/// dimension: 2
struct PlanarFile : CommonFile<2> {
  std::optional<double> angle{};  ///< theta of the posture in which it is held now [rad]
  Domain domain{Domain::all};
};

/// dimension: 3
struct SpatialFile : CommonFile<3> {
  std::optional<Vector<3>> up{};     ///< the posture in which it is held now
  std::optional<Tilt> tilt{};        ///< the postures to choose from; none: all
  std::optional<Gripper> gripper{};  ///< where the contacts come from, if the file has one
};

template <int Dim>
using FileOf = std::conditional_t<Dim == 2, PlanarFile, SpatialFile>;

/// A grasp file, read and checked.
using GraspFile = std::variant<PlanarFile, SpatialFile>;

/// Reads a file, YAML or JSON; "-" is standard input.
/// @throws FileError
GraspFile read_grasp_file(const std::string& file);

/// Reads a text, YAML or JSON; `file` is its name in messages.
/// @throws FileError
GraspFile grasp_from_yaml(std::string text, const std::string& file);

/// The same for JSON alone, for places where there is no YAML.
/// @throws FileError
GraspFile grasp_from_json(std::string text, const std::string& file);

}  // namespace poise
