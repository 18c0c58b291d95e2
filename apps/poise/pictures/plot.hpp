// Drawing with gnuplot.
#pragma once

#include <stdexcept>
#include <string>

#include "files/output.hpp"
#include "readers/input.hpp"

namespace poise {

/// A picture or a page that cannot be made; what() says why.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Runs a gnuplot script that draws on its standard output, and puts the drawing into a file: all
/// of it, or nothing is changed.
/// @throws OutputError, FileError
void draw(const std::string& script, const std::string& path);

}  // namespace poise
