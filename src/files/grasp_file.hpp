// A grasp as people write it down: docs/grasp-file.md.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files/file_error.hpp"
#include "poise/posture.hpp"
#include "shape/shape.hpp"

namespace poise {

/// A grasp file, read and checked. All in SI units and in the object frame; normals point inwards.
struct GraspFile {
  std::string name{};
  int dimension{2};
  double safety{1};
  std::optional<double> angle{};  ///< theta of the posture in which it is held now [rad]
  Domain domain{Domain::all};
  std::optional<Shape> shape{};
  Object<2> object{};
  std::vector<Contact<2>> contacts{};
  /// What is allowed but looks like a mistake: whole lines, "FILE:LINE:COLUMN: path: words".
  std::vector<std::string> warnings{};

  Grasp<2> grasp() const { return Grasp<2>(object, contacts, safety); }
};

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
