// What a turn takes, without a file or a question.
#pragma once

#include "ask/answer.hpp"

namespace poise {

/// What it takes to turn from a posture to another [rad].
/// @throws InvalidGrasp as ways_round()
TurnTaken<2> turn_taken(const Grasp<2>& grasp, double from, double to,
                        const CurveSettings& settings);
/// From an orientation (object to world), in which the posture is `now`.
/// @throws InvalidGrasp as turn_peak() and least_peak_way()
TurnTaken<3> turn_taken(const Grasp<3>& grasp, const Eigen::Quaterniond& from,
                        const Posture<3>& now, const Posture<3>& then,
                        const TurnSettings& settings);

}  // namespace poise
