// Answers for people: newtons first, the effort after them.
#pragma once

#include <string>

#include "files/grasp_file.hpp"
#include "poise/best_posture.hpp"
#include "table.hpp"

namespace poise {

std::string check_report(const GraspFile& file, const Grasp<2>& grasp, const Style& style);
std::string hold_report(const GraspFile& file, const Grasp<2>& grasp, double theta,
                        const Hold<2>& hold, const Style& style);
std::string best_report(const GraspFile& file, const Grasp<2>& grasp, const BestPosture& best,
                        const CurveSettings& settings, const Style& style);
std::string curve_report(const GraspFile& file, const Grasp<2>& grasp, const PostureCurve& curve,
                         const CurveSettings& settings, const Style& style);

}  // namespace poise
