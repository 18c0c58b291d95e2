#include "poise/hold.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "dual/cone_plane.hpp"
#include "hold/solve.hpp"

namespace poise {
namespace {

/// The moments, about the origin, of forces (the top rows) that act at a point.
Eigen::RowVector2d moment_of_force(const Vector<2>& at, const Eigen::Matrix<double, 3, 2>& forces) {
  return at.x() * forces.row(1) - at.y() * forces.row(0);
}
Eigen::Matrix<double, 3, 4> moment_of_force(const Vector<3>& at,
                                            const Eigen::Matrix<double, 6, 4>& forces) {
  Eigen::Matrix<double, 3, 4> moments;
  for (int k = 0; k < 4; ++k) moments.col(k) = at.cross(forces.col(k).head<3>());
  return moments;
}

/// A grip that is proven to be more than the drives give is no hold.
template <int Dim>
Hold<Dim> within_drives(const Hand<Dim>& hand, Hold<Dim> hold) {
  const double most = most_grip(hand);
  if (!hold.holdable || hold.lower_bound <= most) return hold;
  hold.holdable = false;
  hold.effort = hold.residual = hold.grip = 0;
  hold.forces.resize(0);
  return hold;
}

}  // namespace

template <int Dim>
Hold<Dim> hold(const Hand<Dim>& hand, const Load<Dim>& load, const Vector<Dim>& up,
               const HoldSettings& settings) {
  if (settings.objective == Objective::grip)
    return within_drives(hand, least_grip(hand, load, up, settings));
  return solve<Dim>(hand, hand.scaled(), 1, load, up, settings);
}

template <int Dim>
Hold<Dim> hold(const Grasp<Dim>& grasp, const Vector<Dim>& up, const HoldSettings& settings) {
  Hold<Dim> most = hold(grasp, grasp.loads().front(), up, settings);
  for (std::size_t k = 1; k < grasp.loads().size() && most.holdable; ++k) {
    Hold<Dim> other = hold(grasp, grasp.loads()[k], up, settings);
    if (!other.holdable || other.value() > most.value()) most = std::move(other);
  }
  return most;
}

template <int Dim>
Hold<Dim> hold(const Hand<Dim>& hand, const Wrench<Dim>& load, double weight, const Twist<Dim>& y,
               const HoldSettings& settings) {
  if (!load.allFinite() || !y.allFinite())
    throw InvalidGrasp("load", "must be finite, like the twist to start at");
  if (!(weight > 0)) throw InvalidGrasp("weight", "must be above 0");
  if (settings.objective == Objective::grip)
    return within_drives(hand, least_grip(hand, load, weight, settings));
  if (hand.is_general()) return general_hold(hand, 1, load, weight, settings);
  const dual::Problem<Dim> problem(hand.scaled(), weight);
  const Wrench<Dim> w = scaled_wrench(problem.hand, weight, load);
  bool cold = false;
  if constexpr (Dim == 2) cold = dual::in_closed_form(problem);
  Hold<Dim> hold = solve<Dim>(
      problem, w, cold ? dual::cold_start(problem, w) : about_center(problem.hand, weight, y),
      settings);
  write_exact_proof(hand, load, weight, settings.force_cap, hold);
  return hold;
}

template <int Dim>
double phi(const Hand<Dim>& hand, const Twist<Dim>& y) {
  if (hand.is_general()) return static_cast<double>(dual::phi<Dim>(hand, y));
  const dual::Problem<Dim> problem(hand.scaled(), 1);  // in newtons
  dual::Point<Dim> point(problem.size);
  dual::evaluate<Dim, double>(problem, Wrench<Dim>::Zero(), about_center(problem.hand, 1, y),
                              point);
  return -point.value;
}

template <int Dim>
double bound(const Hand<Dim>& hand, const Wrench<Dim>& load, const Twist<Dim>& y) {
  return 2 * (y.dot(load) - phi(hand, y));
}

Vector<2> force_vector(const Contact<2>& contact, const ContactForce<2>& force) {
  const Vector<2>& n = contact.normal;
  return force.normal * n + force.tangential * Vector<2>(-n.y(), n.x());
}

Vector<3> force_vector(const Contact<3>& contact, const ContactForce<3>& force) {
  return force.normal * contact.normal + force.tangential;
}

template <int Dim>
std::vector<FingerForce<Dim>> finger_forces(const Hand<Dim>& hand, const Hold<Dim>& hold) {
  std::vector<FingerForce<Dim>> fingers(hold.holdable ? hand.fingers().size() : 0);
  for (std::size_t i = 0; i < hold.forces.size(); ++i) {
    FingerForce<Dim>& finger = fingers[hand.finger_of(i)];
    finger.normal += hold.forces[i].normal;
    finger.force += force_vector(hand.contacts()[i], hold.forces[i]);
  }
  for (std::size_t k = 0; k < fingers.size(); ++k)
    fingers[k].pressing = fingers[k].force.dot(hand.closing(k));
  return fingers;
}

template <int Dim>
bool all_loaded(const Hand<Dim>& hand, const Hold<Dim>& hold, double weight) {
  const auto fingers = finger_forces(hand, hold);
  return std::all_of(fingers.begin(), fingers.end(), [&](const FingerForce<Dim>& finger) {
    return finger.normal > at_limit * weight;
  });
}

std::string reason(const Hand<2>& hand, const Hold<2>& hold) {
  if (hold.holdable) return {};
  if (!hold.proven) return unproven;
  if (const std::string weak = weak_drives(hand, hold); !weak.empty()) return weak;
  // -y is a motion that gravity drives; about the center, in radii, to tell a turn from a slide.
  const ScaledHand<2>& scaled = hand.scaled();
  const Twist<2> y = about_center(scaled, 1, hold.dual), motion = -y;
  std::ostringstream words;
  words.precision(4);
  words << "it would ";
  if (std::abs(motion[2]) <= 1e-6 * motion.head<2>().norm()) {
    const Vector<2> way = motion.head<2>().normalized();
    words << "slide along (" << rounded(way.x()) << ", " << rounded(way.y()) << ")";
  } else {
    // Where v + omega x r vanishes.
    const Vector<2> centre =
        scaled.center + scaled.length / motion[2] * Vector<2>(-motion[1], motion[0]);
    words << "turn " << (motion[2] > 0 ? "counter-clockwise" : "clockwise") << " about ";
    std::size_t touched = hand.contacts().size();
    for (std::size_t i = 0; i < hand.contacts().size(); ++i)
      if ((hand.contacts()[i].position - centre).norm() <= 1e-6 * hand.radius()) touched = i;
    if (touched < hand.contacts().size())
      words << "contact " << touched;
    else
      words << "(" << rounded(centre.x()) << ", " << rounded(centre.y()) << ") m";
  }
  return words.str() + opposition(hand, y, hold);
}

template <int Dim>
bool force_closure(const Hand<Dim>& hand) {
  // The cone of balanced wrenches is everything if it contains, with a wrench from its inside, also
  // the opposite one, and if it has an inside.
  constexpr int rows = wrench_size<Dim>;
  std::vector<Contact<Dim>> contacts = hand.contacts();
  Wrench<Dim> inside = Wrench<Dim>::Zero();
  Eigen::Matrix<double, rows, rows> span = Eigen::Matrix<double, rows, rows>::Zero();
  const auto G = grasp_matrix(hand);
  const double L = hand.scaled().length;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    Contact<Dim>& contact = contacts[i];
    contact.min_normal = 0;
    contact.max_normal = std::numeric_limits<double>::infinity();
    contact.share = 1;
    constexpr int width = contact_size<Dim>;
    const int first = width * static_cast<int>(i);
    const int forces = contact.friction > 0 ? contact.torsion > 0 ? width : Dim : 1;
    inside += G.col(first);
    Eigen::Matrix<double, rows, width> columns = G.template middleCols<width>(first);
    if (contact.torsion > 0) columns.col(width - 1) *= contact.torsion;
    columns.bottomRows(rows - Dim) -= moment_of_force(hand.center(), columns);
    columns.bottomRows(rows - Dim) /= L;
    span += columns.leftCols(forces) * columns.leftCols(forces).transpose();
    if (contact.pad) span += Eigen::Matrix<double, rows, rows>::Identity();  // it feels all
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, rows, rows>> eigen(span);
  if (eigen.eigenvalues()[0] <= 1e-12 * eigen.eigenvalues()[rows - 1]) return false;
  const Hand<Dim> cones(std::move(contacts), hand.center());
  return hold<Dim>(cones, -inside, 1, Twist<Dim>::Zero()).holdable;
}

const char* to_string(ContactState state) {
  constexpr const char* names[] = {"unloaded", "sticking", "slipping"};
  return names[static_cast<int>(state)];
}

const char* to_string(ForceLimit limit) {
  constexpr const char* names[] = {"none", "min", "max"};
  return names[static_cast<int>(limit)];
}

#define POISE_INSTANTIATE(Dim)                                                              \
  template Hold<Dim> hold(const Grasp<Dim>&, const Vector<Dim>&, const HoldSettings&);      \
  template Hold<Dim> hold(const Hand<Dim>&, const Load<Dim>&, const Vector<Dim>&,           \
                          const HoldSettings&);                                             \
  template Hold<Dim> hold(const Hand<Dim>&, const Wrench<Dim>&, double, const Twist<Dim>&,  \
                          const HoldSettings&);                                             \
  template double phi(const Hand<Dim>&, const Twist<Dim>&);                                 \
  template double bound(const Hand<Dim>&, const Wrench<Dim>&, const Twist<Dim>&);           \
  template std::vector<FingerForce<Dim>> finger_forces(const Hand<Dim>&, const Hold<Dim>&); \
  template bool all_loaded(const Hand<Dim>&, const Hold<Dim>&, double);                     \
  template bool force_closure(const Hand<Dim>&);
POISE_INSTANTIATE(2)
POISE_INSTANTIATE(3)
#undef POISE_INSTANTIATE

}  // namespace poise
