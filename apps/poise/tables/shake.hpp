// What is withstood besides the load, in words.
#pragma once

#include <string>

#include "poise/shake.hpp"

namespace poise {

/// "3.52 m/s² (0.3589 g)"
std::string acceleration_text(double acceleration);
/// The acceleration that is withstood besides the load: "3.52 m/s² (0.3589 g) in any direction,
/// weakest along (0.00, 1.00)".
template <int Dim>
std::string shake_text(const Shake<Dim>& found);

}  // namespace poise
