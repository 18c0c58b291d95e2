// The least grip of contacts that drives move: docs/theory.md, "The least grip". Not installed.
//
//   minimise Λ F + ½|f|²  subject to  G f = w,  f in K,  e_a <= F for all drives
//   maximise yᵀw − φ(Gᵀy − λ ζ)  over y and λ >= 0 with Σ λ = Λ
//
// with ζ what a contact feels of its drive at speed 1. For growing Λ the grip comes down to the
// least, and the rate at which (y, λ) grow proves it. Everything is in the units of
// contact_lane.hpp, ζ as ScaledDrives has it.
#pragma once

#include "dual/dual.hpp"

namespace poise::dual {

/// What a load needs of the drives.
template <int Dim>
struct LeastGrip {
  explicit LeastGrip(std::size_t contacts) : point(contacts) {}

  double value{0};   ///< F of the forces
  Point<Dim> point;  ///< the forces, of least effort but for the room; what is left of the balance
  Twist<Dim> y;      ///< with the rates, which add up to 1, the proof: F >= y . w - fixed
  SmallVector<double, 16> rates;
  double fixed{0};  ///< what contacts with limits can do
};

/// From the y of a hold against w, of which `effort` is |f|². False where it does not come to an
/// end at which value and proof agree.
template <int Dim>
bool least_grip(const Problem<Dim>& problem, const Driven<Dim>& driven, const Wrench<Dim>& w,
                const Point<Dim>& held, LeastGrip<Dim>& found);

/// Whether found.y, which tells w from what can be held, proves that it needs more than `most`;
/// then the rates are 0 or add up to 1.
template <int Dim>
bool refute(const Problem<Dim>& problem, const Driven<Dim>& driven, const Wrench<Dim>& w,
            double most, LeastGrip<Dim>& found);

}  // namespace poise::dual
