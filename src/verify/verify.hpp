// Re-checks the result of any command from the grasp alone: docs/certificate.md.
#pragma once

#include "files/grasp_file.hpp"
#include "verify/claims.hpp"

namespace poise::verify {

/// Checks all that a result document claims of the grasp of a file.
/// @throws FileError where the document is not a result, lacks something or has it of a wrong type
Claims verify(const GraspFile& file, const Document& result);

}  // namespace poise::verify
