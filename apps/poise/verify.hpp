// poise verify: a result checked again.
#pragma once

#include <string>

#include "files/grasp_file.hpp"
#include "tables/table.hpp"

namespace poise {

struct Verdict {
  std::string text;  ///< for standard output
  bool confirmed{false};
  bool open{false};  ///< the result itself says that its answer is not known
};

/// @throws FileError where the result cannot be read
Verdict verdict(const GraspFile& grasp, const std::string& result, bool json, const Style& style);

}  // namespace poise
