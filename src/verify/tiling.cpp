#include <algorithm>

#include "verify/curve.hpp"
#include "verify/fork.hpp"

namespace poise::verify {
namespace {

/// pi and 2 pi as documents and answers have them, in doubles.
constexpr Real half_turn = std::numbers::pi, full_turn = 2 * half_turn;

/// Checks an interval against those before it.
void check_interval(Verdict& verdict, const Path& place, const std::vector<Interval>& holdable,
                    std::size_t k) {
  const Real from = holdable[k].from, to = holdable[k].to;
  verdict.check(
      place, "from is in [-180, 180), from <= to <= from + 360",
      from >= -half_turn && from < half_turn && from <= to && to <= from + full_turn + 1e-12L);
  for (std::size_t i = 0; i < k; ++i) {
    const Real next = unwound(from, holdable[i].from);
    verdict.check(place, "intervals do not overlap",
                  next > holdable[i].to && next + to - from < holdable[i].from + 2 * pi);
  }
}

/// Takes the arcs in an interval that are not in another yet, in their order.
Chain chain_in(Real from, Real to, const std::vector<RealArc>& arcs, std::vector<bool>& used) {
  Chain chain;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    RealArc arc = arcs[i];
    arc.from = unwound(arc.from, from);
    arc.to += arc.from - arcs[i].from;
    if (used[i] || arc.to > to + end_slack) continue;
    used[i] = true;
    chain.arcs.push_back(arc);
  }
  std::stable_sort(chain.arcs.begin(), chain.arcs.end(),
                   [](const RealArc& a, const RealArc& b) { return a.from < b.from; });
  return chain;
}

/// The greatest length of arcs in a row that are too narrow to prove anything.
Real narrow_in(const Chain& chain) {
  Real widest = 0, width = 0;
  for (const RealArc& arc : chain.arcs) {
    width = arc.is_sliver() ? width + arc.to - arc.from : 0;
    widest = std::max(widest, width);
  }
  return widest;
}

/// How far the arcs of a chain are from tiling an interval.
Real gap_in(const Chain& chain, Real from, Real to) {
  if (chain.arcs.empty()) return 2 * pi;
  Real gap = std::max(std::abs(chain.from() - from), std::abs(chain.to() - to));
  for (std::size_t i = 1; i < chain.arcs.size(); ++i)
    gap = std::max(gap, std::abs(chain.arcs[i].from - chain.arcs[i - 1].to));
  return gap;
}

}  // namespace

RealDomain domain_of(const RealGrasp& grasp, Domain domain) {
  const Wedge wedge = wedge_of(grasp, grasp.loads.front());
  if (domain == Domain::all || wedge.empty()) return {-pi, pi, true};
  return {wedge.to, wedge.from + 2 * pi, false};
}

std::vector<Chain> check_tiling(Verdict& verdict, const Path& list,
                                const std::vector<RealArc>& arcs,
                                const std::vector<Interval>& holdable, const RealDomain& domain) {
  std::vector<Chain> chains;
  std::vector<bool> used(arcs.size());
  for (std::size_t k = 0; k < holdable.size(); ++k) {
    const Path place = list[k];
    check_interval(verdict, place, holdable, k);
    const bool whole = Real{holdable[k].to} - holdable[k].from >= full_turn;
    const bool anchored = whole && !arcs.empty();
    const Real from = anchored ? arcs.front().from : holdable[k].from;
    const Real to = anchored ? from + 2 * pi : Real{holdable[k].to};
    Chain chain = chain_in(from, to, arcs, used);
    chain.circle = whole;
    verdict.check(place, "arcs tile the interval [rad]", gap_in(chain, from, to), end_slack);
    verdict.check(place, "few arcs are too narrow to prove anything [rad]", narrow_in(chain),
                  most_narrow);
    if (!chain.arcs.empty()) chains.push_back(std::move(chain));
  }
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const RealArc& arc = arcs[i];
    const auto same = [&](const RealArc& other) {
      return other.from == arc.from && other.to == arc.to;
    };
    verdict.check(arc.place, "arcs are listed once",
                  std::none_of(arcs.begin(), arcs.begin() + static_cast<std::ptrdiff_t>(i), same));
    verdict.check(arc.place, "arc lies in a holdable interval", used[i]);
    if (domain.circle) continue;
    const Real from = unwound(arc.from, domain.from);
    verdict.check(arc.place, "arc lies in the domain [rad]",
                  std::max(domain.from - from, from + arc.to - arc.from - domain.to), end_slack);
  }
  return chains;
}

}  // namespace poise::verify
