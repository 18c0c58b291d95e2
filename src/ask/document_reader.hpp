// JSON documents read back into what they claim.
#pragma once

#include <variant>

#include "ask/claims.hpp"
#include "files/value.hpp"

namespace poise {

/// What the document of some command claims of a grasp; a curve is of the plane.
template <int Dim>
using AnyDocument =
    std::variant<CheckDocument<Dim>, HoldDocument<Dim>, BestDocument<Dim>, TurnDocument<Dim>,
                 CapacityDocument<Dim>, SturdyDocument<Dim>, CurveDocument>;

/// Reads the document of an answer about a grasp of this dimension.
/// @throws FileError where it is none, lacks something or has it of a wrong type
template <int Dim>
AnyDocument<Dim> read_document(const Document& document);

}  // namespace poise
