// A grasp, or what it may be, as Python gives them.
#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "values.hpp"

namespace poise::python {

using GraspPointer = std::shared_ptr<AnyGrasp>;
/// A grasp, or the scenarios of one in space.
using GraspOrScenarios = std::variant<GraspPointer, std::vector<GraspPointer>>;

/// The same contacts with the loads of all scenarios.
inline Grasp<3> together(const std::vector<GraspPointer>& scenarios) {
  if (scenarios.empty()) throw InvalidGrasp("scenarios", "is empty, must hold at least one");
  const std::vector<Contact<3>>& contacts = only<3>(*scenarios.front()).contacts();
  std::vector<Load<3>> loads;
  for (const GraspPointer& scenario : scenarios) {
    const Grasp<3>& grasp = only<3>(*scenario);
    if (grasp.contacts() != contacts)
      throw InvalidGrasp("scenarios", "must all have the same contacts");
    loads.insert(loads.end(), grasp.loads().begin(), grasp.loads().end());
  }
  const Grasp<3>& first = only<3>(*scenarios.front());
  return {loads, given_contacts(first), 1, first.mechanism()};
}

/// One grasp of them.
inline GraspPointer as_one(const GraspOrScenarios& held) {
  if (const auto* const scenarios = std::get_if<std::vector<GraspPointer>>(&held))
    return std::make_shared<AnyGrasp>(AnyGrasp{together(*scenarios)});
  return std::get<GraspPointer>(held);
}

}  // namespace poise::python
