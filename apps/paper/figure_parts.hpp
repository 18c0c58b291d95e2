// What the figures have in common.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/paper/exact.hpp"
#include "files/degrees.hpp"
#include "pictures/script.hpp"

namespace poise::study {

using Line = std::vector<Vector<2>>;

/// The title above a picture.
void headline(Script& script, const std::string& text, double height);

/// The edges of the next plot, as parts of the picture.
void place(Script& script, double left, double right, double bottom, double top);

/// The postures of the whole circle along x; grey outside the range of pinching up.
void posture_axis(Script& script, const HeldDisk& disk);

/// A function of the posture over the circle or a part of it.
template <class Function>
Line sampled(double from, double to, Function value) {
  Line line;
  constexpr int steps = 360;
  for (int k = 0; k <= steps; ++k) {
    const double theta = from + (to - from) * k / steps;
    line.emplace_back(degrees(theta), value(theta));
  }
  return line;
}

/// V on its branches, over the range.
std::vector<Line> effort_lines(const HeldDisk& disk);

/// a, b, c; and b, where it is no minimum, too.
std::vector<Minimum> marked_postures(const HeldDisk& disk);

/// One length of arrows for all postures, in metres to a newton, such that those of a finger and of
/// the weight on one line do not meet; by posture where the forces differ too much.
std::optional<double> arrow_scale(const HeldDisk& disk, const std::vector<Minimum>& postures);

}  // namespace poise::study
