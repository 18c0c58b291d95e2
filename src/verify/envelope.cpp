#include <algorithm>
#include <cmath>
#include <limits>

#include "verify/checks.hpp"
#include "verify/curve.hpp"

namespace poise::verify {
namespace {

/// What of a load's own curve is along an arc, in its order and unwound to it.
std::vector<RealArc> along(const RealArc& arc, const std::vector<RealArc>& curve) {
  std::vector<RealArc> pieces;
  for (const RealArc& own : curve)
    for (int turn = -2; turn <= 2; ++turn) {
      RealArc piece = own;
      piece.from += 2 * pi * turn;
      piece.to += 2 * pi * turn;
      if (piece.from <= arc.to + end_slack && piece.to >= arc.from - end_slack)
        pieces.push_back(std::move(piece));
    }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const RealArc& a, const RealArc& b) { return a.from < b.from; });
  return pieces;
}

/// The widest part of an arc that ascending pieces leave out.
Real hole_in(const RealArc& arc, const std::vector<RealArc>& pieces) {
  Real reached = arc.from, widest = pieces.empty() ? std::numeric_limits<Real>::infinity() : 0;
  for (const RealArc& piece : pieces) {
    widest = std::max(widest, piece.from - reached);
    reached = std::max(reached, piece.to);
  }
  return std::max(widest, arc.to - reached);
}

Effort less(const Effort& a, const Effort& b) {
  return {a.c0 - b.c0, a.cos1 - b.cos1, a.sin1 - b.sin1, a.cos2 - b.cos2, a.sin2 - b.sin2};
}

}  // namespace

void check_envelope(Verdict& verdict, const EachLoad& grasps, const std::vector<RealArc>& arcs,
                    const std::vector<std::vector<RealArc>>& curves, const OptionsClaim& options) {
  for (const RealArc& arc : arcs) {
    if (arc.is_sliver()) continue;
    const Real unit =
        std::max(arc.value.least(arc.from, arc.to), little(grasps[arc.load], options.objective));
    for (std::size_t k = 0; k < curves.size(); ++k) {
      const std::vector<RealArc> pieces = along(arc, curves[k]);
      verdict.check(arc.place, "each load is held along the arc [rad]", hole_in(arc, pieces),
                    2 * end_slack);
      for (const RealArc& piece : pieces) {
        // Where they only touch, rounding puts the end of either.
        const Real from = std::clamp(arc.from, piece.from, piece.to);
        const Real to = std::clamp(arc.to, piece.from, piece.to);
        const Real beside = std::max(std::abs(from - std::clamp(from, arc.from, arc.to)),
                                     std::abs(to - std::clamp(to, arc.from, arc.to)));
        const Real rounding = 1e-12L * (arc.value.scale() + piece.value.scale()) +
                              beside * std::abs(piece.value.slope(from));
        verdict.check(arc.place / "load", "no load needs more along the arc [of the least there]",
                      less(piece.value, arc.value).greatest(from, to) / unit,
                      1e-7L + rounding / unit);
      }
    }
  }
}

}  // namespace poise::verify
