// Turns as Python has them: with their grasp, so that they are told in words and drawn.
#pragma once

#include "ask/answer.hpp"
#include "values.hpp"

namespace poise::python {

template <int Dim>
struct Stretch : UnholdableStretch<Dim> {
  GraspPointer grasp;
};
using AnyStretch = Either<Stretch>;

template <int Dim>
struct Peak : TurnPeak<Dim> {
  GraspPointer grasp;
};
using AnyPeak = Either<Peak>;

/// The straight turn, with what else is known.
template <int Dim>
struct Turned : AnyPeak {
  Turned(const GraspPointer& turned, TurnAnswer<Dim> all)
      : AnyPeak{Peak<Dim>{all.taken.straight, turned}}, grasp(turned), answer(std::move(all)) {}
  GraspPointer grasp;
  TurnAnswer<Dim> answer;
};

}  // namespace poise::python
