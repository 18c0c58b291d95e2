// A hand as the interior-point method sees it, and its answers in newtons. Not installed.
#pragma once

#include "dual/interior.hpp"
#include "dual/scaled_hand.hpp"
#include "poise/grip.hpp"

namespace poise {

/// Forces in weights W, lengths in radii L, moments about the hand's center.
/// @param friction_factor  multiplies all frictions and torsions
template <int Dim>
dual::ConeHand<Dim> cone_hand(const Hand<Dim>& hand, double weight, dual::Wanted wanted,
                              double friction_factor = 1);

/// What a unit of the scaled grip is in grip_unit(): W, W L or 1.
template <int Dim>
double scaled_grip(const Hand<Dim>& hand, double weight);

/// The forces of what was found, with their states, residual and effort.
template <int Dim>
void write_balance(const Hand<Dim>& hand, double weight, const dual::ConeHand<Dim>& cones,
                   const dual::Balance<Dim>& balance, Hold<Dim>& hold, double friction_factor = 1);

/// A hand whose limits are all those of drives, counted in parts: the limit of a contact is that of a
/// drive that moves it alone along its normal. So the least part of them is a least grip.
template <int Dim>
struct PartHand {
  dual::ConeHand<Dim> cones;  ///< first the hand's limited drives, then those of contacts
  double unit;                ///< the grip F that is a part of 1: of the size of the load
};
template <int Dim>
PartHand<Dim> part_hand(const Hand<Dim>& hand, double friction_factor, double weight);

/// How much of their limits drives and contacts use at least: the greatest part of `max` or
/// `max_normal` that any of them gives.
template <int Dim>
struct LeastPart {
  typename dual::Balance<Dim>::State state;  ///< open: all the same (y, rates) may prove something
  double part;
  /// For all parts p with which the load is balanced,
  /// p (sum of rates . max + what contacts with max_normal can do) + what those with min_normal
  /// must do >= y . load, y about the object frame's origin.
  Twist<Dim> y;
  SmallVector<double, 4> rates;  ///< of the drives, per newton or newton metre of max
};
/// That of a hand in which something is limited.
template <int Dim>
LeastPart<Dim> least_part(const Hand<Dim>& hand, double friction_factor, const Wrench<Dim>& load,
                          double weight);

/// The hold of least effort of a hand that is_general().
template <int Dim>
Hold<Dim> general_hold(const Hand<Dim>& hand, double friction_factor, const Wrench<Dim>& load,
                       double weight, const HoldSettings& settings);

}  // namespace poise
