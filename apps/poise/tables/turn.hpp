// What turns take, in words.
#pragma once

#include <string>

#include "ask/answer.hpp"
#include "tables/table.hpp"

namespace poise {

/// "turn by 30.00° counter-clockwise", in the plane; "stay".
std::string turn_text(double angle);
/// "turn by 30.00° about (0.000, 1.000, 0.000)"
std::string turn_text(const Turn& turn);

/// What the straight turn needs on the way from one posture to another, and the way that needs less
/// where there is one.
std::string taken_text(const Grasp<2>& grasp, const Posture<2>& now, const Posture<2>& then,
                       const TurnTaken<2>& taken, const Style& style);
std::string taken_text(const Grasp<3>& grasp, const Eigen::Quaterniond& start,
                       const Posture<3>& now, const Posture<3>& then, const TurnTaken<3>& taken,
                       const Style& style);

/// The best posture that can be reached without pressing harder.
std::string reach_text(const Grasp<2>& grasp, const Posture<2>& now, const Reachable<2>& reach);
std::string reach_text(const Grasp<3>& grasp, const Eigen::Quaterniond& start,
                       const Posture<3>& now, const Reachable<3>& reach, const Style& style);

}  // namespace poise
