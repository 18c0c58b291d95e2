// poise batch: many grasps, a line for each.
#pragma once

#include "arguments.hpp"
#include "commands.hpp"

namespace poise {

/// Writes the records; tells on standard error how far it is, and at the end how many there are.
/// @throws FileError for inputs and outputs that cannot be used, UsageError
Answer batch(const Arguments& arguments);

}  // namespace poise
