// Vacuum and magnets: what pulls the object onto a finger. docs/theory.md, "Adhesion".
#pragma once

#include <vector>

#include "poise/hand.hpp"

namespace poise {

/// A constant pull V at a contact: the finger's force on the object is f = f' - V n, where f' lies in
/// the friction cone.
template <int Dim>
struct Pull {
  Contact<Dim> at;  ///< in space it may be a pad: the pull acts in the middle of it
  double force{0};  ///< V [N], > 0
};

/// Adds pulls to the contacts of a hand. Each becomes a contact of its own: without friction, against
/// the normal of the one that it pulls on, in whose forces f' is told.
///
/// Where every finger is pulled on, and drives have no max and are not listed, nothing closes the
/// fingers but the vacuum: each pull is a finger of its own with a drive, "cup vacuum", whose `max`
/// is V. Then the least grip is the part of the vacuum that is needed. Otherwise the pull is constant,
/// and belongs to the finger that it pulls on; the closing direction of that stays as it was.
/// @throws InvalidGrasp where a force is not above 0
template <int Dim>
void add_pulls(const std::vector<Pull<Dim>>& pulls, std::vector<Contact<Dim>>& contacts,
               Mechanism<Dim>& mechanism);

}  // namespace poise
