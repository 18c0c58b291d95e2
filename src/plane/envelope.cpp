#include "plane/envelope.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/harmonic.hpp"
#include "plane/tracer.hpp"

namespace poise {
namespace {

using std::numbers::pi;

/// Values that differ by less, in parts of their coefficients, are equal.
constexpr double rounding = 1e-13;

/// A part of a piece of a load's curve: of an arc, or of an unholdable one.
struct Part {
  double from, to;
  const Arc* arc;
  const UnholdableArc* gap;

  bool is_same_piece(const Part& other) const { return arc == other.arc && gap == other.gap; }
};
using Parts = std::vector<Part>;  // ascending, apart where neither is known

/// Adds a part, or prolongs the last by it.
void append(Parts& parts, const Part& part) {
  if (!parts.empty() && parts.back().is_same_piece(part) && parts.back().to == part.from)
    parts.back().to = part.to;
  else
    parts.push_back(part);
}

/// A curve cut at the ends of its domain, without single postures.
Parts parts_of(const PostureCurve& curve) {
  Parts parts;
  const auto add = [&](double from, double to, const Arc* arc, const UnholdableArc* gap) {
    for (const double turn : {-2 * pi, 0.0, 2 * pi}) {
      const Part part{std::max(from + turn, curve.domain.from),
                      std::min(to + turn, curve.domain.to), arc, gap};
      if (part.to - part.from > same_angle) parts.push_back(part);
    }
  };
  for (const Arc& arc : curve.arcs) add(arc.from, arc.to, &arc, nullptr);
  for (const UnholdableArc& gap : curve.unholdable_arcs) add(gap.from, gap.to, nullptr, &gap);
  std::sort(parts.begin(), parts.end(),
            [](const Part& a, const Part& b) { return a.from < b.from; });
  return parts;
}

double scale(const Harmonic2& V) {
  return std::abs(V.c0) + std::abs(V.cos1) + std::abs(V.sin1) + std::abs(V.cos2) + std::abs(V.sin2);
}

/// The greater of two arcs between two postures.
void append_greater(const Arc& a, const Arc& b, double from, double to, Parts& parts) {
  const Harmonic2 &A = a.value, &B = b.value;
  const Harmonic2 above{B.c0 - A.c0, B.cos1 - A.cos1, B.sin1 - A.sin1, B.cos2 - A.cos2,
                        B.sin2 - A.sin2};
  const double equal = rounding * (scale(A) + scale(B));
  double reached = from;
  const auto go_to = [&](double end) {
    const bool rises = above((reached + end) / 2) > equal;
    append(parts, {reached, end, rises ? &b : &a, nullptr});
    reached = end;
  };
  if (scale(above) > equal)
    for (const Root& root : sign_changes(above, from, to))
      if (root.at - reached > same_angle && to - root.at > same_angle) go_to(root.at);
  go_to(to);
}

Parts greater(const Parts& a, const Parts& b) {
  std::vector<double> ends;
  for (const Parts* parts : {&a, &b})
    for (const Part& part : *parts) ends.insert(ends.end(), {part.from, part.to});
  std::sort(ends.begin(), ends.end());
  Parts parts;
  auto in_a = a.begin(), in_b = b.begin();
  const auto part_at = [](double at, Parts::const_iterator& part, const Parts& all) {
    while (part != all.end() && part->to <= at) ++part;
    return part != all.end() && part->from <= at ? &*part : nullptr;
  };
  for (std::size_t k = 0; k + 1 < ends.size();) {
    const double from = ends[k++];
    // What is narrower than rounding belongs to what comes after it.
    while (k + 1 < ends.size() && ends[k] - from <= same_angle) ++k;
    const double to = ends[k], middle = (from + to) / 2;
    if (to - from <= same_angle) break;
    const Part *of_a = part_at(middle, in_a, a), *of_b = part_at(middle, in_b, b);
    const bool no_a = of_a && of_a->gap, no_b = of_b && of_b->gap;
    if (no_a || no_b)
      append(parts, {from, to, nullptr, (no_a ? of_a : of_b)->gap});
    else if (of_a && of_b)
      append_greater(*of_a->arc, *of_b->arc, from, to, parts);
  }
  return parts;
}

}  // namespace

void trace_envelope(const std::vector<PostureCurve>& loads, PostureCurve& envelope) {
  Parts parts = parts_of(loads.front());
  for (std::size_t k = 1; k < loads.size(); ++k) parts = greater(parts, parts_of(loads[k]));
  const bool circle = envelope.domain.to - envelope.domain.from >= 2 * pi;
  if (circle && parts.size() > 1 && parts.front().is_same_piece(parts.back()) &&
      parts.front().from == envelope.domain.from && parts.back().to == envelope.domain.to) {
    parts.back().to = parts.front().to + 2 * pi;
    parts.erase(parts.begin());
  }
  for (const Part& part : parts) {
    if (part.gap) {
      UnholdableArc& gap = envelope.unholdable_arcs.emplace_back(*part.gap);
      gap.from = part.from;
      gap.to = part.to;
      continue;
    }
    Arc& arc = envelope.arcs.emplace_back(*part.arc);
    arc.from = part.from;
    arc.to = part.to;
    const PostureCurve& of = loads[arc.load];
    const auto first = of.states.begin() + static_cast<std::ptrdiff_t>(arc.first_state);
    const auto contacts = static_cast<std::ptrdiff_t>(of.states.size() / of.arcs.size());
    arc.first_state = envelope.states.size();
    envelope.states.insert(envelope.states.end(), first, first + contacts);
  }
}

}  // namespace poise
