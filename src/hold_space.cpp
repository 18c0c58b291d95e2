#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "dual.hpp"
#include "poise/hold.hpp"
#include "twist.hpp"

namespace poise {
namespace {

constexpr double at_limit = 1e-9;  // of the weight, and of the friction

void check(const HoldSettings& settings) {
  if (!(settings.force_cap > 0) || !(settings.force_cap <= 1e9))
    throw InvalidGrasp("force_cap", "must be above 0 and at most 1e9 weights");
}

/// The forces of one lane of contacts in newtons, without a branch: which contacts are loaded is
/// hard to foresee.
void write_forces(const ContactLane<3>& c, const dual::LaneForces<3, double>& lane,
                  const ScaledGrasp<3>& scaled, double weight, ContactForce<3>* forces,
                  std::size_t count) {
  const Lane zero{}, n = lane.f[0], a = lane.f[1], b = lane.f[2], s = lane.f[3];
  const Lane normal = n * c.unit, moment = s * c.unit * c.soft * scaled.length;
  Lane tangential[3];
  for (int d = 0; d < 3; ++d) tangential[d] = weight * (a * c.a[d] + b * c.b[d]);
  Lane beside = a * a + b * b + s * s;
  for (std::size_t k = 0; k < lane_size; ++k) beside[k] = std::sqrt(beside[k]);
  const Lane share = beside / (c.mu * n);  // 0 / 0 without friction
  const Lane used = share < 1.0 ? share : zero + 1;
  const auto loaded = normal > at_limit * weight, slips = used >= 1 - at_limit;
  const Lane friction_used = loaded ? used : zero;
  const auto state = (loaded & 1) + (loaded & slips & 1);
  for (std::size_t k = 0; k < count; ++k)
    forces[k] = {normal[k],
                 {tangential[0][k], tangential[1][k], tangential[2][k]},
                 moment[k],
                 friction_used[k],
                 static_cast<ContactState>(state[k]),
                 ForceLimit::none};
}

ForceLimit limit_of(const Contact<3>& contact, double normal, double near) {
  if (normal >= contact.max_normal - near) return ForceLimit::max;
  return contact.min_normal > 0 && normal <= contact.min_normal + near ? ForceLimit::min
                                                                       : ForceLimit::none;
}

Hold<3> solve(const Grasp<3>& grasp, const Wrench<3>& w, const Twist<3>& start,
              const HoldSettings& settings) {
  check(settings);
  const ScaledGrasp<3>& scaled = grasp.scaled();
  dual::Point<3> point(scaled.size);
  Hold<3> hold;
  hold.holdable = dual::maximise(scaled, w, start, settings.force_cap, point);
  const double weight = grasp.object().weight, square = weight * weight;
  hold.dual = about_origin(grasp, point.y);
  if (!hold.holdable) {
    hold.proven = dual::lower_bound(point) > settings.force_cap * settings.force_cap;
    // Finite for weights whose square nearly overflows, too.
    hold.lower_bound =
        std::min(square * dual::lower_bound(point), std::numeric_limits<double>::max());
    return hold;
  }
  hold.residual = std::max(point.residual.head<3>().norm(),
                           grasp.radius() > 0 ? point.residual.tail<3>().norm() : 0);
  hold.forces.resize(scaled.size);
  for (std::size_t i = 0; i < scaled.size; i += lane_size)
    write_forces(scaled.lanes[i / lane_size], point.lanes[i / lane_size], scaled, weight,
                 &hold.forces[i], std::min(lane_size, scaled.size - i));
  if (scaled.limited)
    for (std::size_t i = 0; i < scaled.size; ++i)
      hold.forces[i].limit =
          limit_of(grasp.contacts()[i], hold.forces[i].normal, at_limit * weight);
  hold.effort = square * dual::squared_norm(point);
  // A long y may ask more for the load itself than for one within the balance tolerance.
  hold.lower_bound = std::min(square * 2 * point.value, hold.effort);
  return hold;
}

/// For words: without the minus of a rounded zero.
double rounded(double value) { return std::abs(value) < 1e-9 ? 0 : value; }

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
