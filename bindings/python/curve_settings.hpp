#pragma once

#include "values.hpp"

namespace poise::python {

inline CurveSettings curve_settings(Domain domain, double force_cap, Objective objective) {
  return {.domain = domain, .force_cap = checked_cap(force_cap), .objective = objective};
}

}  // namespace poise::python
