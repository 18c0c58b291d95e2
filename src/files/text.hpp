// Texts as they come: which bytes are characters, and how to quote them in a message.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "files/value.hpp"

namespace poise {

/// Bytes of the UTF-8 character that begins at `at`; 0 where none does (RFC 3629, section 4).
std::size_t character_size(std::string_view text, std::size_t at);

/// Whether the character at `at` is a control character: line ends and tabs are.
bool is_control(std::string_view text, std::size_t at);

/// Fit for one line of a message: shortened, and without control characters.
std::string shown(std::string_view text);

/// The whole of a file, or one byte more than `most`; "-" is standard input.
/// @throws FileError
std::string read_text(const std::string& file, std::size_t most = max_text);

/// What messages call a file: its name, or "standard input".
std::string file_name(const std::string& file);

}  // namespace poise
