// Completion for bash, from what the commands declare.
#pragma once

#include <deque>
#include <string>

#include "flags.hpp"

namespace poise {

/// A script that has bash complete command lines of the program: commands, flags, and the files and
/// words that they take.
std::string completion(const CLI::App& program, const std::deque<Flags>& commands);

}  // namespace poise
