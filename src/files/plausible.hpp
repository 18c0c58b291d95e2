#pragma once

#include <string>
#include <vector>

#include "files/field.hpp"
#include "files/grasp_file.hpp"

namespace poise {

/// The path of the object in a scenario: "object", or "object.scenarios[1]" where there are some.
std::string object_path(const Field& root, std::size_t scenario);

/// What is allowed but looks like a mistake, one line each: wrong units, normals that point the
/// wrong way, contacts off the shape or on top of each other. The grasps are those of the file's
/// scenarios.
template <int Dim>
std::vector<std::string> doubts(const CommonFile<Dim>& file, const std::vector<Grasp<Dim>>& grasps,
                                const Field& root);

}  // namespace poise
