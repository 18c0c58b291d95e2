// Files that are written whole or not at all, and never over what was read.
#pragma once

#include <string>
#include <string_view>

#include "files/file_error.hpp"

namespace poise {

/// Where a file is written.
struct Target {
  std::string path;       ///< where a link leads to
  bool is_stream{false};  ///< a device or a pipe: it is written to, and stays what it is
};

/// To be asked before the work is done whose result is written.
/// @throws FileError for a folder, a disk or a socket, for a link to nothing, for what this run has
///         read, and where there is no folder to write in
Target target_of(const std::string& path);

/// Puts a text into a file: all of it, or nothing is changed.
/// @throws FileError
void write_file(const std::string& text, const std::string& path);

/// Writes to an open file; whether all of it arrived: errno says why not.
bool write_all(int file, std::string_view text);

/// Opens a device or a pipe to write to it. @throws FileError
int open_stream(const std::string& path);

}  // namespace poise
