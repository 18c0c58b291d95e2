#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "hold/solve.hpp"

namespace poise {
namespace {

Hold<3> solve(const Grasp<3>& grasp, const Wrench<3>& w, const Twist<3>& start,
              const HoldSettings& settings) {
  const double weight = grasp.object().weight, length = grasp.scaled().length;
  return solve(grasp, w, start, settings,
               [&](const ContactLane<3>& c, const dual::LaneForces<3, double>& lane,
                   ContactForce<3>* forces, std::size_t count) {
                 const Lane n = lane.f[0], a = lane.f[1], b = lane.f[2], s = lane.f[3];
                 const Lane normal = n * c.unit, moment = s * c.unit * c.soft * length;
                 Lane tangential[3];
                 for (int d = 0; d < 3; ++d) tangential[d] = weight * (a * c.a[d] + b * c.b[d]);
                 Lane beside = a * a + b * b + s * s;
                 for (std::size_t k = 0; k < lane_size; ++k) beside[k] = std::sqrt(beside[k]);
                 const LaneStates states(normal, beside / (c.mu * n), weight);
                 for (std::size_t k = 0; k < count; ++k)
                   forces[k] = {normal[k], {tangential[0][k], tangential[1][k], tangential[2][k]},
                                moment[k], states.friction_used[k],
                                states[k], ForceLimit::none};
               });
}

std::string text(const Vector<3>& v) {
  std::ostringstream words;
  words.precision(4);
  words << '(' << rounded(v.x()) << ", " << rounded(v.y()) << ", " << rounded(v.z()) << ')';
  return words.str();
}

}  // namespace

template <>
Hold<3> hold(const Grasp<3>& grasp, const Vector<3>& up, const HoldSettings& settings) {
  if (!(std::abs(up.squaredNorm() - 1) <= 1e-6)) throw InvalidGrasp("up", "must be a unit vector");
  Wrench<3> w;
  w << up, 0, 0, 0;
  return solve(grasp, w, dual::cold_start<3>(grasp.scaled(), w), settings);
}

template <>
Hold<3> hold(const Grasp<3>& grasp, const Wrench<3>& load, const Twist<3>& y,
             const HoldSettings& settings) {
  if (!load.allFinite() || !y.allFinite())
    throw InvalidGrasp("load", "must be finite, like the twist to start at");
  const Vector<3> force = load.head<3>();
  const Vector<3> moment = load.tail<3>() - grasp.object().com.cross(force);
  Wrench<3> w;
  w << force, moment / grasp.scaled().length;
  return solve(grasp, w * grasp.scaled().per_weight, about_com(grasp, y), settings);
}

template <>
std::vector<FingerForce<3>> finger_forces(const Grasp<3>& grasp, const Hold<3>& hold) {
  std::vector<FingerForce<3>> fingers(hold.holdable ? grasp.fingers().size() : 0);
  for (std::size_t i = 0; i < hold.forces.size(); ++i) {
    FingerForce<3>& finger = fingers[grasp.finger_of(i)];
    finger.normal += hold.forces[i].normal;
    finger.force += hold.forces[i].normal * grasp.contacts()[i].normal + hold.forces[i].tangential;
  }
  return fingers;
}

Manner manner(const Grasp<3>& grasp, const Vector<3>& up, const Hold<3>& hold) {
  if (grasp.fingers().size() == 1 || !all_loaded(grasp, hold)) return Manner::resting;
  return cradled(grasp, up) ? Manner::cradled : Manner::pinched;
}

std::string reason(const Grasp<3>& grasp, const Hold<3>& hold) {
  if (hold.holdable) return {};
  if (!hold.proven)
    return "it is within rounding of the limit of holding, where neither forces nor a proof that "
           "there are none were found";
  const ScaledGrasp<3>& scaled = grasp.scaled();
  const auto& contacts = grasp.contacts();
  // -y is a motion that gravity drives; about the com, in radii, to tell a turn from a slide.
  const Twist<3> y = about_com(grasp, hold.dual);
  const Vector<3> v = -y.head<3>(), omega = -y.tail<3>();
  std::string words = "it would ";
  bool between_points = false;
  if (omega.norm() <= 1e-6 * v.norm()) {
    words += "slide along " + text(v.normalized());
  } else {
    // The axis of the screw: where v + omega x r is along omega.
    const Vector<3> axis = omega.normalized();
    const Vector<3> at = grasp.object().com + scaled.length / omega.squaredNorm() * omega.cross(v);
    const bool slides = std::abs(v.dot(axis)) > 1e-6 * (v.norm() + omega.norm());
    words += slides ? "turn about and slide along " : "turn about ";
    std::vector<std::size_t> touched;
    for (std::size_t i = 0; i < contacts.size(); ++i)
      if ((contacts[i].position - at).cross(axis).norm() <= 1e-6 * grasp.radius())
        touched.push_back(i);
    std::size_t other = touched.size();  // on the line, at another point than the first
    for (std::size_t k = touched.size(); k-- > 1;)
      if ((contacts[touched[k]].position - contacts[touched[0]].position).norm() >
          1e-6 * grasp.radius())
        other = k;
    if (other < touched.size()) {
      words += "the line through contacts " + std::to_string(touched[0]) + " and " +
               std::to_string(touched[other]);
      between_points = !slides && touched.size() == contacts.size();
    } else if (!touched.empty()) {
      words += "the line through contact " + std::to_string(touched[0]) + " along " + text(axis);
    } else {
      words += "the line through " + text(at) + " m along " + text(axis);
    }
  }
  // Contacts at a limit of their normal force do oppose it, or even push.
  bool weak = false, strong = false;
  dual::Point<3> point(scaled.size);
  dual::evaluate<3, double>(scaled, Wrench<3>::Zero(), y, point);
  for (std::size_t i = 0; i < scaled.size; ++i) {
    const ContactLane<3>& c = scaled.lanes[i / lane_size];
    const double n = point.f(i)[0], lo = c.lo[i % lane_size], hi = c.hi[i % lane_size];
    weak = weak || (!(n < hi) && hi > 0 && hi > lo);
    strong = strong || (!(n > lo) && lo > 0);
  }
  words += weak     ? ", although the contacts that oppose it press with their max_normal"
           : strong ? ", since contacts must press with their min_normal"
                    : ", and no contact opposes it";
  if (between_points)
    words += "; point contacts on one line cannot resist that torque: a soft finger (torsion) can";
  return words;
}

}  // namespace poise
