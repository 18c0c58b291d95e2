#pragma once

#include <filesystem>
#include <string>
#include <system_error>

#include "readers/readers.hpp"

namespace poise {

/// @throws ReadError unless it is a file that has an end
inline void check_regular_file(const std::string& file) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::file_status status = fs::status(file, ignored);
  if (!fs::exists(status)) throw ReadError("does not exist");
  if (fs::is_directory(status)) throw ReadError("is a folder, must be a file");
  if (!fs::is_regular_file(status)) throw ReadError("is not a regular file");
}

}  // namespace poise
