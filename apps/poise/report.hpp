// Answers for people: newtons first, the effort after them.
#pragma once

#include <string>

#include "files/grasp_file.hpp"
#include "files/result.hpp"
#include "poise/best_posture.hpp"
#include "poise/best_spatial_posture.hpp"
#include "table.hpp"

namespace poise {

std::string check_report(const PlanarFile& file, const Grasp<2>& grasp, const Style& style);
std::string hold_report(const PlanarFile& file, const Grasp<2>& grasp, double theta,
                        const Hold<2>& hold, const Style& style);
std::string best_report(const PlanarFile& file, const Grasp<2>& grasp, const BestPosture& best,
                        const CurveSettings& settings, const Style& style);
std::string curve_report(const PlanarFile& file, const Grasp<2>& grasp, const PostureCurve& curve,
                         const CurveSettings& settings, const Style& style);

/// In space: the grasps are one for each scenario.
std::string check_report(const SpatialFile& file, const std::vector<Grasp<3>>& grasps,
                         const Style& style);
std::string hold_report(const SpatialFile& file, const std::vector<Grasp<3>>& grasps,
                        const SpatialPosture& posture, const HoldSettings& settings,
                        const Style& style);
/// How the object is held now; not `known` where nobody said.
struct Present {
  Eigen::Quaterniond orientation;  ///< object to world
  bool known;
};
std::string best_report(const SpatialFile& file, const std::vector<Grasp<3>>& grasps,
                        const BestSpatialPosture& best, const SpatialSettings& settings,
                        const Present& present, const Style& style);

/// What a gripper can hold: postures one after the other, in each all scenarios.
template <int Dim>
std::string capacity_report(const CommonFile<Dim>& file, const std::vector<Grasp<Dim>>& grasps,
                            const std::vector<CapacityAt<Dim>>& answers,
                            const CapacityOptions& options, const Style& style);

}  // namespace poise
