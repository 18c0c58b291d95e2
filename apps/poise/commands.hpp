// What each command answers.
#pragma once

#include <string>

#include "arguments.hpp"

namespace poise {

struct Answer {
  std::string text;  ///< for standard output
  bool holds{true};  ///< whether the object can be held (somewhere), or the result is confirmed
};

/// @throws FileError for a bad grasp file, OutputError for a picture that cannot be drawn
Answer answer(const Arguments& arguments);

}  // namespace poise
