// Covering postures by pieces of a curve. Not installed.
#pragma once

#include <numbers>
#include <vector>

#include "plane/harmonic.hpp"
#include "plane/tracer.hpp"

namespace poise {

/// Fills an interval with pieces: piece_at(at, lo, hi) finds the one around a posture, as far as it
/// goes within lo, hi. Each covers the posture at which it is asked for, so that they end.
void cover(double from, double to, std::size_t contacts, const auto& piece_at) {
  std::vector<Interval> open;
  open.reserve(16);
  open.push_back({from, to});
  // There are about 4 arcs for each contact; at the limit of holding, where rounding decides, there
  // may be no end of them.
  std::size_t probes = 64 * (contacts + 16), fruitless = 200;
  while (!open.empty() && probes-- > 0) {
    const auto [lo, hi] = open.back();
    open.pop_back();
    if (hi - lo <= same_angle) continue;
    const Interval piece = piece_at(lo + off_middle * (hi - lo), lo, hi);
    const bool found = piece.to - piece.from > undecidable;
    if (!found && (hi - lo < undecidable || fruitless == 0)) continue;
    if (!found) --fruitless;
    open.push_back({lo, piece.from});
    open.push_back({piece.to, hi});
  }
}

/// The same once around: from the end of the piece around some posture to its start.
void cover_circle(std::size_t contacts, const auto& piece_at) {
  constexpr double some = 0.1, pi = std::numbers::pi;
  const Interval first = piece_at(some, some - pi, some + pi);
  cover(first.to, first.from + 2 * pi, contacts, piece_at);
}

}  // namespace poise
