// Files that are written whole or not at all, and drawing with gnuplot.
#pragma once

#include <stdexcept>
#include <string>

namespace poise {

/// A file that cannot be written or a picture that cannot be drawn; what() says why.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Puts a text into a file: all of it, or nothing is changed.
/// @throws OutputError
void write_file(const std::string& text, const std::string& path);

/// Runs a gnuplot script that draws on its standard output, and puts the drawing into a file: all
/// of it, or nothing is changed.
/// @throws OutputError
void draw(const std::string& script, const std::string& path);

}  // namespace poise
