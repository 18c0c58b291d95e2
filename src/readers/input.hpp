// What is read: files that have an end, and are not written over by the same run.
#pragma once

#include <string>
#include <string_view>

#include "meshes/formats.hpp"

namespace poise {

/// To be called before a file is read.
/// @throws ReadError unless it is a file that has an end: a folder, a pipe or a device is none
void check_input(const std::string& file);

/// Notes a file that will be read, whatever it is; "-" is standard input.
void note_input(const std::string& file);

/// Whether a path leads to a file that was noted or checked as input, by whatever name.
bool is_input(const std::string& path);

/// The whole of a file.
/// @throws ReadError also where it is too large, or a pointer of Git LFS instead of the file
std::string read_input(const std::string& file);

/// Whether the name of a file ends like this, in small or capital letters.
bool has_ending(const std::string& file, std::string_view ending);

}  // namespace poise
