// The command `paper`: what the paper shows, and what the exact answer adds.
#pragma once

#include <string>

#include "arguments.hpp"
#include "table.hpp"

namespace poise {

/// Writes figures, table and findings into a directory.
/// @return what to print
/// @throws OutputError
std::string paper(const PaperArguments& arguments, bool json, const Style& style);

}  // namespace poise
