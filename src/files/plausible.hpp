#pragma once

#include <string>
#include <vector>

#include "files/field.hpp"
#include "files/grasp_file.hpp"

namespace poise {

/// What is allowed but looks like a mistake, one line each: wrong units, normals that point the
/// wrong way, contacts off the shape or on top of each other. The grasp is that of the file.
template <int Dim>
std::vector<std::string> doubts(const CommonFile<Dim>& file, const Grasp<Dim>& grasp,
                                const Field& root);

}  // namespace poise
