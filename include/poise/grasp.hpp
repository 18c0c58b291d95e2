// A hand and the loads that it must hold.
#pragma once

#include <concepts>
#include <vector>

#include "poise/hand.hpp"
#include "poise/load.hpp"

namespace poise {

/// A hand with what acts on the object: one load, or several of which each must be held, with
/// forces of its own. Immutable.
template <int Dim>
class Grasp : public Hand<Dim> {
 public:
  /// The hand is made about the centre of mass of the first load.
  /// @param safety  every friction and torsion is divided by it, >= 1
  /// @throws InvalidGrasp where a number is not finite or out of its range, a normal has no length,
  ///         there are no contacts or no loads, or a drive moves a finger that there is not.
  Grasp(const Load<Dim>& load, std::vector<Contact<Dim>> contacts, double safety = 1,
        Mechanism<Dim> mechanism = {});
  /// A template, so that the braces of a load are never taken for those of a vector.
  template <std::same_as<std::vector<Load<Dim>>> Loads>
  Grasp(Loads loads, std::vector<Contact<Dim>> contacts, double safety = 1,
        Mechanism<Dim> mechanism = {});

  const std::vector<Load<Dim>>& loads() const { return loads_; }  ///< at least one
  /// The size of the largest load [N].
  double size() const { return size_; }

 private:
  std::vector<Load<Dim>> loads_;
  double size_{0};
};

}  // namespace poise
