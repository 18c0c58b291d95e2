// What a posture has of each load.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "poise/posture.hpp"
#include "values.hpp"

namespace poise::python {

template <int Dim>
std::vector<AnyHold> holds_of(const Posture<Dim>& posture) {
  std::vector<AnyHold> list;
  for (const Hold<Dim>& hold : posture.holds) list.push_back({hold});
  return list;
}

/// Infinite where it cannot be held.
template <int Dim>
std::vector<double> numbers_of(const Posture<Dim>& posture, double Hold<Dim>::*number) {
  std::vector<double> list;
  for (const Hold<Dim>& hold : posture.holds)
    list.push_back(hold.holdable ? hold.*number : std::numeric_limits<double>::infinity());
  return list;
}

/// Nothing where the objective is the effort.
template <int Dim>
std::optional<std::vector<double>> grips_of(const Posture<Dim>& posture) {
  // That nothing holds is told in terms of the effort.
  const bool is_grip =
      std::any_of(posture.holds.begin(), posture.holds.end(),
                  [](const Hold<Dim>& hold) { return hold.objective == Objective::grip; });
  if (!is_grip) return {};
  return numbers_of(posture, &Hold<Dim>::grip);
}

/// The attributes of a posture, of one dimension or of either, that tell of its loads.
template <class P>
void add_loads(Class<P>& posture) {
  const auto of = [](auto get) {
    return [get](const P& any) {
      const auto own = [&get]<int Dim>(const Posture<Dim>& each) { return get(each); };
      if constexpr (requires { any.of; })
        return std::visit(own, any.of);
      else
        return own(any);
    };
  };
  posture
      .attribute("load", of([](const auto& each) { return each.decides; }),
                 "Index of the load that decides: the first that cannot be held, else the one that "
                 "needs most.")
      .attribute("holds", of([](const auto& each) { return holds_of(each); }), "One for each load.")
      .attribute("load_efforts", of([]<int Dim>(const Posture<Dim>& each) {
                   return numbers_of(each, &Hold<Dim>::effort);
                 }),
                 "Of each load [N^2]; inf where it cannot be held.")
      .attribute("load_grips", of([](const auto& each) { return grips_of(each); }),
                 "Of each load, of objective grip; inf where it cannot be held. None of objective "
                 "effort.");
}

}  // namespace poise::python
