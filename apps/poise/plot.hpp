// Drawing with gnuplot.
#pragma once

#include <stdexcept>
#include <string>

namespace poise {

/// A picture that cannot be drawn; what() says why.
class PlotError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Runs a gnuplot script that draws on its standard output, and puts the drawing into a file: all
/// of it, or nothing is changed.
/// @throws PlotError
void draw(const std::string& script, const std::string& path);

}  // namespace poise
