#pragma once

#include "files/grasp_file.hpp"
#include "files/value.hpp"

namespace poise {

/// The one reader of grasp files, whatever text they came as.
/// @throws FileError
GraspFile grasp_from(const Document& document);

}  // namespace poise
