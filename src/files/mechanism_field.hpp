// Pads, fingers and drives of a grasp file.
#pragma once

#include "files/field.hpp"
#include "poise/hand.hpp"

namespace poise {

/// {size: [x, y], axis, grid}, or {points, shares, axis, reach}; `unit` is the length unit [m].
Pad read_pad(const Field& field, double unit, const Vector<3>& normal);

/// The mechanism of a file: `drives` and `fingers`, where it has them.
/// @param mechanism  where the file does not say
template <int Dim>
Mechanism<Dim> read_mechanism(const Field& root, double unit,
                              const std::vector<Contact<Dim>>& contacts,
                              Mechanism<Dim> mechanism = {});

}  // namespace poise
