// Answers as JSON documents, for programs: docs/command-line.md.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files/grasp_file.hpp"
#include "poise/best_posture.hpp"
#include "poise/best_spatial_posture.hpp"
#include "poise/capacity.hpp"

namespace poise {

/// An angle in degrees, never -0.
double degrees(double radians);

/// The force of the finger on the object at a contact, object frame [N].
Vector<2> force_vector(const Contact<2>& contact, const ContactForce<2>& force);
Vector<3> force_vector(const Contact<3>& contact, const ContactForce<3>& force);

/// The posture that a hold was asked for, as it was given; neither where the file's was taken.
struct PostureOption {
  std::optional<double> angle_deg{};
  std::optional<Vector<2>> up{};
};

/// Each of these is one JSON document in lines of readable length.
std::string check_document(const PlanarFile& file, const Grasp<2>& grasp);
std::string hold_document(const Grasp<2>& grasp, double theta, const Hold<2>& hold,
                          const HoldSettings& settings, const PostureOption& option = {});
std::string best_document(const Grasp<2>& grasp, const BestPosture& best,
                          const CurveSettings& settings);
std::string curve_document(const Grasp<2>& grasp, const PostureCurve& curve,
                           const CurveSettings& settings);

/// In space: the grasps are one for each scenario; `up` is the option as it was given, if it was;
/// `orientation` is the present one, object to world.
std::string check_document(const SpatialFile& file, const std::vector<Grasp<3>>& grasps);
std::string hold_document(const std::vector<Grasp<3>>& grasps, const SpatialPosture& posture,
                          const HoldSettings& settings, const std::optional<Vector<3>>& up = {});
std::string best_document(const std::vector<Grasp<3>>& grasps, const BestSpatialPosture& best,
                          const SpatialSettings& settings, const Eigen::Quaterniond& orientation);

/// What a gripper can hold in a posture, in one scenario.
template <int Dim>
struct CapacityAt {
  std::string posture{};  ///< which one: given, now, best or upright
  Vector<Dim> up;
  std::size_t scenario{0};
  Capacity<Dim> capacity;
};

/// The options are those given, as they were given.
struct CapacityOptions {
  double force_cap{1e6}, safety{1.5};
  std::optional<double> angle_deg{};
  std::vector<double> up{};
};
template <int Dim>
std::string capacity_document(const std::vector<Grasp<Dim>>& grasps,
                              const std::vector<CapacityAt<Dim>>& answers,
                              const CapacityOptions& options);

}  // namespace poise
