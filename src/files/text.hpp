// The texts of files.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "files/value.hpp"
#include "shape/characters.hpp"

namespace poise {

/// The whole of a file, or one byte more than `most`; "-" is standard input.
/// @throws FileError
std::string read_text(const std::string& file, std::size_t most = max_text);

/// What messages call a file: its name, or "standard input".
std::string file_name(const std::string& file);

}  // namespace poise
