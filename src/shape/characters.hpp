// Texts as they come: which bytes are characters, and how to show them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace poise {

/// Bytes of the UTF-8 character that begins at `at`; 0 where none does (RFC 3629, section 4).
std::size_t character_size(std::string_view text, std::size_t at);

/// Whether the character at `at` is a control character: line ends and tabs are.
bool is_control(std::string_view text, std::size_t at);

/// Whether the character at `at` is not seen, and may change how others are: bidirectional and
/// zero-width ones, separators of lines, what is no character.
bool is_unseen(std::string_view text, std::size_t at);

/// Fit for one line of a message: shortened and harmless.
std::string shown(std::string_view text);

/// With a ? for each character that is not seen, and each control character that is not `kept`.
std::string harmless(std::string_view text, std::string_view kept = "\n");

}  // namespace poise
