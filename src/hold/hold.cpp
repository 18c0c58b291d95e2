#include "poise/hold.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "dual/ascend.hpp"
#include "hold/solve.hpp"

namespace poise {
namespace {

/// A load in the solver's units, about the centre of mass.
Wrench<2> scaled_load(const Grasp<2>& grasp, const Wrench<2>& load) {
  const Vector<2>& com = grasp.object().com;
  const double moment = load[2] - (com.x() * load[1] - com.y() * load[0]);
  return Wrench<2>(load[0], load[1], moment / grasp.scaled().length) * grasp.scaled().per_weight;
}

/// z of a contact: its velocity, in the contact frame, by a twist about the com.
Vector<2> contact_velocity(const Grasp<2>& grasp, std::size_t i, const Twist<2>& scaled) {
  const ContactLane<2>& c = grasp.scaled().lanes[i / lane_size];
  const std::size_t k = i % lane_size;
  const double ux = scaled[0] + scaled[2] * c.jx[k], uy = scaled[1] + scaled[2] * c.jy[k];
  return {c.nx[k] * ux + c.ny[k] * uy, c.nx[k] * uy - c.ny[k] * ux};
}

/// The moments, about the origin, of forces (the top rows) that act at the com.
Eigen::RowVector2d moment_of_com(const Vector<2>& com, const Eigen::Matrix<double, 3, 2>& forces) {
  return com.x() * forces.row(1) - com.y() * forces.row(0);
}
Eigen::Matrix<double, 3, 4> moment_of_com(const Vector<3>& com,
                                          const Eigen::Matrix<double, 6, 4>& forces) {
  Eigen::Matrix<double, 3, 4> moments;
  for (int k = 0; k < 4; ++k) moments.col(k) = com.cross(forces.col(k).head<3>());
  return moments;
}

Hold<2> solve(const Grasp<2>& grasp, const Wrench<2>& w, const Twist<2>& start,
              const HoldSettings& settings) {
  const double weight = grasp.object().weight;
  return solve(grasp, w, start, settings,
               [&](const ContactLane<2>& c, const dual::LaneForces<2, double>& lane,
                   ContactForce<2>* forces, std::size_t count) {
                 const Lane n = lane.f[0], t = lane.f[1];
                 const Lane normal = n * c.unit, tangential = t * c.unit;
                 const LaneStates states(normal, dual::magnitude(t) / (c.mu * n), weight);
                 for (std::size_t k = 0; k < count; ++k)
                   forces[k] = {normal[k], tangential[k], states.friction_used[k], states[k],
                                ForceLimit::none};
               });
}

}  // namespace

template <>
Hold<2> hold(const Grasp<2>& grasp, const Vector<2>& up, const HoldSettings& settings) {
  if (!(std::abs(up.squaredNorm() - 1) <= 1e-6)) throw InvalidGrasp("up", "must be a unit vector");
  const Wrench<2> w(up.x(), up.y(), 0);
  return solve(grasp, w, dual::cold_start<2>(grasp.scaled(), w), settings);
}

template <>
Hold<2> hold(const Grasp<2>& grasp, const Wrench<2>& load, const Twist<2>& y,
             const HoldSettings& settings) {
  if (!load.allFinite() || !y.allFinite())
    throw InvalidGrasp("load", "must be finite, like the twist to start at");
  const Wrench<2> w = scaled_load(grasp, load);
  const ScaledGrasp<2>& scaled = grasp.scaled();
  return solve(grasp, w,
               dual::in_closed_form(scaled) ? dual::cold_start<2>(scaled, w) : about_com(grasp, y),
               settings);
}

template <>
std::vector<FingerForce<2>> finger_forces(const Grasp<2>& grasp, const Hold<2>& hold) {
  std::vector<FingerForce<2>> fingers(hold.holdable ? grasp.fingers().size() : 0);
  for (std::size_t i = 0; i < hold.forces.size(); ++i) {
    const Vector<2>& n = grasp.contacts()[i].normal;
    FingerForce<2>& finger = fingers[grasp.finger_of(i)];
    finger.normal += hold.forces[i].normal;
    finger.force +=
        hold.forces[i].normal * n + hold.forces[i].tangential * Vector<2>(-n.y(), n.x());
  }
  return fingers;
}

template <int Dim>
double grip_force(const Grasp<Dim>& grasp, const Hold<Dim>& hold) {
  double most = 0;
  for (const FingerForce<Dim>& finger : finger_forces(grasp, hold))
    most = std::max(most, finger.normal);
  return most;
}

template <int Dim>
bool all_loaded(const Grasp<Dim>& grasp, const Hold<Dim>& hold) {
  const auto fingers = finger_forces(grasp, hold);
  return std::all_of(fingers.begin(), fingers.end(), [&](const FingerForce<Dim>& finger) {
    return finger.normal > at_limit * grasp.object().weight;
  });
}

Manner manner(const Grasp<2>& grasp, const Vector<2>& up, const Hold<2>& hold) {
  if (grasp.fingers().size() == 1 || !all_loaded(grasp, hold)) return Manner::resting;
  const Interval wedge = cradled_wedge(grasp);
  const double middle = (wedge.from + wedge.to) / 2, half = (wedge.to - wedge.from) / 2;
  const double off = std::abs(std::remainder(angle_of(up) - middle, 2 * 3.141592653589793));
  return off < half - 1e-12 ? Manner::cradled : Manner::pinched;
}

std::string reason(const Grasp<2>& grasp, const Hold<2>& hold) {
  if (hold.holdable) return {};
  if (!hold.proven)
    return "it is within rounding of the limit of holding, where neither forces nor a proof that "
           "there are none were found";
  // -y is a motion that gravity drives; about the com, in radii, to tell a turn from a slide.
  const Twist<2> motion = -about_com(grasp, hold.dual);
  const Vector<2>& com = grasp.object().com;
  std::ostringstream words;
  words.precision(4);
  words << "it would ";
  if (std::abs(motion[2]) <= 1e-6 * motion.head<2>().norm()) {
    const Vector<2> way = motion.head<2>().normalized();
    words << "slide along (" << rounded(way.x()) << ", " << rounded(way.y()) << ")";
  } else {
    // Where v + omega x r vanishes.
    const Vector<2> centre =
        com + grasp.scaled().length / motion[2] * Vector<2>(-motion[1], motion[0]);
    words << "turn " << (motion[2] > 0 ? "counter-clockwise" : "clockwise") << " about ";
    std::size_t touched = grasp.contacts().size();
    for (std::size_t i = 0; i < grasp.contacts().size(); ++i)
      if ((grasp.contacts()[i].position - centre).norm() <= 1e-6 * grasp.radius()) touched = i;
    if (touched < grasp.contacts().size())
      words << "contact " << touched;
    else
      words << "(" << rounded(centre.x()) << ", " << rounded(centre.y()) << ") m";
  }
  // Contacts at a limit of their normal force do oppose it, or even push.
  bool weak = false, strong = false;
  const ScaledGrasp<2>& scaled = grasp.scaled();
  for (std::size_t i = 0; i < scaled.size; ++i) {
    const Contact<2>& contact = grasp.contacts()[i];
    const Vector<2> z = contact_velocity(grasp, i, about_com(grasp, hold.dual));
    const dual::Face<> face = dual::face<double>(scaled, i, z);
    weak = weak || (face.at_hi && contact.max_normal > 0);
    strong = strong || (face.at_lo && contact.min_normal > 0);
  }
  words << (weak     ? ", although the contacts that oppose it press with their max_normal"
            : strong ? ", since contacts must press with their min_normal"
                     : ", and no contact opposes it");
  return words.str();
}

template <int Dim>
bool force_closure(const Grasp<Dim>& grasp) {
  // The cone of balanced wrenches is everything if it contains, with a wrench from its inside, also
  // the opposite one, and if it has an inside.
  constexpr int rows = wrench_size<Dim>;
  std::vector<Contact<Dim>> contacts = grasp.contacts();
  Wrench<Dim> inside = Wrench<Dim>::Zero();
  Eigen::Matrix<double, rows, rows> span = Eigen::Matrix<double, rows, rows>::Zero();
  const auto G = grasp_matrix(grasp);
  const double W = grasp.object().weight, L = grasp.scaled().length;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    Contact<Dim>& contact = contacts[i];
    contact.min_normal = 0;
    contact.max_normal = std::numeric_limits<double>::infinity();
    contact.share = 1;
    constexpr int width = contact_size<Dim>;
    const int first = width * static_cast<int>(i);
    const int forces = contact.friction > 0 ? contact.torsion > 0 ? width : Dim : 1;
    inside += W * G.col(first);
    Eigen::Matrix<double, rows, width> columns = G.template middleCols<width>(first);
    if (contact.torsion > 0) columns.col(width - 1) *= contact.torsion;
    columns.bottomRows(rows - Dim) -= moment_of_com(grasp.object().com, columns);
    columns.bottomRows(rows - Dim) /= L;
    span += columns.leftCols(forces) * columns.leftCols(forces).transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, rows, rows>> eigen(span);
  if (eigen.eigenvalues()[0] <= 1e-12 * eigen.eigenvalues()[rows - 1]) return false;
  const Grasp<Dim> cones(grasp.object(), std::move(contacts));
  return hold<Dim>(cones, -inside, Twist<Dim>::Zero()).holdable;
}

template bool force_closure<2>(const Grasp<2>&);
template bool force_closure<3>(const Grasp<3>&);

const char* to_string(ContactState state) {
  constexpr const char* names[] = {"unloaded", "sticking", "slipping"};
  return names[static_cast<int>(state)];
}

const char* to_string(ForceLimit limit) {
  constexpr const char* names[] = {"none", "min", "max"};
  return names[static_cast<int>(limit)];
}

template double grip_force<2>(const Grasp<2>&, const Hold<2>&);
template double grip_force<3>(const Grasp<3>&, const Hold<3>&);
template bool all_loaded<2>(const Grasp<2>&, const Hold<2>&);
template bool all_loaded<3>(const Grasp<3>&, const Hold<3>&);

}  // namespace poise
