#include <Eigen/Eigenvalues>
#include <cmath>
#include <string>

#include "motion/spline.hpp"
#include "poise/motion.hpp"

namespace poise {
namespace {

void check_list(const std::string& name, std::size_t size, std::size_t expected) {
  if (size != expected)
    throw InvalidGrasp(name, "has " + std::to_string(size) + " entries, must have " +
                                 std::to_string(expected) + " as times has");
}

std::string at(const char* list, std::size_t k) {
  return std::string(list) + "[" + std::to_string(k) + "]";
}

void check_trajectory(const Trajectory& trajectory) {
  const std::size_t n = trajectory.times.size();
  check_list("positions", trajectory.positions.size(), n);
  check_list("orientations", trajectory.orientations.size(), n);
  if (!trajectory.accelerations.empty())
    check_list("accelerations", trajectory.accelerations.size(), n);
  for (std::size_t k = 0; k < n; ++k) {
    if (!std::isfinite(trajectory.times[k]) ||
        (k > 0 && !(trajectory.times[k] > trajectory.times[k - 1])))
      throw InvalidGrasp(at("times", k), "must be finite and above the one before");
    if (!trajectory.positions[k].allFinite())
      throw InvalidGrasp(at("positions", k), "must be finite");
    const double norm = trajectory.orientations[k].norm();
    if (!(norm > 0) || !std::isfinite(norm))
      throw InvalidGrasp(at("orientations", k), "must be finite and not all 0");
    if (!trajectory.accelerations.empty() && !trajectory.accelerations[k].allFinite())
      throw InvalidGrasp(at("accelerations", k), "must be finite");
  }
}

/// Of q / |q| with the derivatives of q: d/dt q = 1/2 (0, omega) q.
void write_rotation(const Eigen::Quaterniond& q, const Eigen::Vector4d& first,
                    const Eigen::Vector4d& second, MotionState& state) {
  const auto quaternion = [](const Eigen::Vector4d& v) {
    return Eigen::Quaterniond(v[3], v[0], v[1], v[2]);
  };
  state.angular_velocity = 2 * (quaternion(first) * q.conjugate()).vec();
  state.angular_acceleration = 2 * (quaternion(second) * q.conjugate()).vec() -
                               2 * q.coeffs().dot(first) * state.angular_velocity;
}

}  // namespace

std::string inertia_problem(const Eigen::Matrix3d& inertia) {
  constexpr double rounding = 1e-6;  // of files with few digits
  if (!inertia.allFinite()) return "is not finite";
  const double size = inertia.cwiseAbs().maxCoeff();
  if ((inertia - inertia.transpose()).cwiseAbs().maxCoeff() > rounding * size)
    return "is not symmetric";
  const Eigen::Vector3d moments =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  if (moments[0] < -rounding * size) return "has a negative principal moment, which no body has";
  if (moments[2] > moments[0] + moments[1] + rounding * size)
    return "has a principal moment above the sum of the two others, which no body has";
  return {};
}

std::vector<MotionState> motion_through(const Trajectory& trajectory) {
  check_trajectory(trajectory);
  const auto n = static_cast<Eigen::Index>(trajectory.times.size());
  Eigen::MatrixXd points(n, 7);
  std::vector<MotionState> states(trajectory.times.size());
  for (std::size_t k = 0; k < states.size(); ++k) {
    states[k].time = trajectory.times[k];
    states[k].position = trajectory.positions[k];
    Eigen::Quaterniond q = trajectory.orientations[k].normalized();
    if (k > 0 && q.dot(states[k - 1].orientation) < 0) q.coeffs() = -q.coeffs();
    states[k].orientation = q;
    points.row(static_cast<Eigen::Index>(k)) << states[k].position.transpose(),
        q.coeffs().transpose();
  }
  const SplineDerivatives along = spline(trajectory.times, points);
  for (std::size_t k = 0; k < states.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    states[k].acceleration = trajectory.accelerations.empty()
                                 ? Vector<3>(along.second.row(row).head<3>())
                                 : trajectory.accelerations[k];
    write_rotation(states[k].orientation, along.first.row(row).tail<4>(),
                   along.second.row(row).tail<4>(), states[k]);
  }
  return states;
}

MotionLoad motion_load(const Body& body, const MotionState& state) {
  if (!(body.mass > 0) || !std::isfinite(body.mass))
    throw InvalidGrasp("mass", "must be above 0 and finite");
  const Eigen::Matrix3d to_object = state.orientation.normalized().toRotationMatrix().transpose();
  const Vector<3> acceleration = to_object * state.acceleration;
  const Vector<3> omega = to_object * state.angular_velocity;
  const Vector<3> alpha = to_object * state.angular_acceleration;
  const Vector<3>& com = body.com;
  const auto term = [&](const Vector<3>& at_com, const Vector<3>& moment) {
    Wrench<3> wrench = wrench_of<3>(body.mass * at_com, com);
    wrench.tail<3>() += moment;
    return wrench;
  };
  const Vector<3> none = Vector<3>::Zero();
  MotionLoad load{{term(standard_gravity * to_object.col(2), none), term(acceleration, none),
                   term(alpha.cross(com), body.inertia * alpha),
                   term(omega.cross(omega.cross(com)), omega.cross(body.inertia * omega))}};
  if (!load.at().allFinite()) throw InvalidGrasp("states", "must be finite");
  return load;
}

const char* to_string(LoadTerm term) {
  constexpr const char* names[] = {"weight", "linear", "angular", "centripetal"};
  return names[static_cast<int>(term)];
}

}  // namespace poise
