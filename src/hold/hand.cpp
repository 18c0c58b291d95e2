#include "poise/grasp.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string_view>

#include "dual/scaled_hand.hpp"

namespace poise {
namespace {

std::string text(double value) {
  std::ostringstream out;
  out.precision(12);
  out << value;
  return out.str();
}

/// Where a number stands: its path is written only when something is wrong with it.
struct Place {
  const char* field;
  std::size_t contact = static_cast<std::size_t>(-1);
  int component = -1;

  std::string path() const {
    std::string path;
    if (contact != static_cast<std::size_t>(-1)) path = "contacts[" + std::to_string(contact) + "].";
    path += field;
    if (component >= 0) path += "[" + std::to_string(component) + "]";
    return path;
  }
};

[[noreturn, gnu::cold]] void refuse(double value, const Place& place, const char* expected) {
  throw InvalidGrasp(place.path(), "is " + text(value) + ", must be " + expected);
}

/// Throws unless `value` is finite with a finite square, and `in_range`. Inline, so that no place
/// is made where nothing is wrong: making a grasp should cost no more than a hold.
[[gnu::always_inline]] inline void check(double value, bool in_range, const Place& place,
                                         const char* expected) {
  if (!(std::isfinite(value * value) && in_range)) refuse(value, place, expected);
}

template <int Dim>
[[noreturn, gnu::cold]] void refuse(const Vector<Dim>& value, Place place) {
  for (int k = 0; k < Dim; ++k) {
    Place component = place;
    component.component = k;
    check(value[k], true, component, "a finite number");
  }
  throw InvalidGrasp(place.path(), "is too long: its square overflows");
}

template <int Dim>
[[gnu::always_inline]] inline void check(const Vector<Dim>& value, const Place& place) {
  if (!std::isfinite(value.squaredNorm())) refuse<Dim>(value, place);
}

template <int Dim>
void check(const Contact<Dim>& contact, std::size_t i) {
  check<Dim>(contact.position, {"position", i});
  check<Dim>(contact.normal, {"normal", i});
  if (!(contact.normal.cwiseAbs().maxCoeff() > 0))
    throw InvalidGrasp(Place{"normal", i}.path(),
                       "has no length, must point from the finger inwards");
  check(contact.friction, contact.friction >= 0, {"friction", i}, "at least 0");
  check(contact.min_normal, contact.min_normal >= 0, {"min_normal", i}, "at least 0");
  const double max = contact.max_normal;
  if (max != std::numeric_limits<double>::infinity())
    check(max, max >= 0, {"max_normal", i}, "at least 0");
  if (max < contact.min_normal)
    throw InvalidGrasp(Place{"max_normal", i}.path(), "is " + text(max) +
                                                          ", must be at least min_normal, " +
                                                          text(contact.min_normal));
  check(contact.share, contact.share > 0 && contact.share <= 1, {"share", i},
        "above 0 and at most 1");
  const double torsion = contact.torsion;
  if (Dim == 2) check(torsion, torsion == 0, {"torsion", i}, "0 in the plane");
  check(torsion, torsion >= 0, {"torsion", i}, "at least 0");
  check(torsion, torsion == 0 || contact.friction > 0, {"torsion", i},
        "0 where there is no friction");
  // The solver divides by it.
  check(torsion > 0 ? contact.friction / torsion : 0, true, {"torsion", i},
        "less small against the friction");
}

/// Of a normal whose length is above 0, whatever its size.
template <int Dim>
Vector<Dim> unit(const Vector<Dim>& normal) {
  const double squared = normal.squaredNorm();
  const bool plain = squared > 1e-200 && squared < 1e200;
  return plain ? Vector<Dim>(normal / std::sqrt(squared)) : Vector<Dim>(normal.stableNormalized());
}

template <int Dim>
const std::vector<Load<Dim>>& checked(const std::vector<Load<Dim>>& loads) {
  if (loads.empty()) throw InvalidGrasp("loads", "is empty, must hold at least one load");
  for (const Load<Dim>& load : loads) {
    check(load.weight, load.weight > 0, {"object.weight"}, "above 0");
    check<Dim>(load.com, {"object.com"});
    if (!load.fixed.allFinite()) throw InvalidGrasp("object.fixed", "must be finite");
  }
  return loads;
}

/// The contact's columns of G about the origin: the normal force first.
Eigen::Matrix<double, 3, 2> columns(const Contact<2>& contact) {
  const Vector<2> r = contact.position, n = contact.normal, t(-n.y(), n.x());
  Eigen::Matrix<double, 3, 2> c;
  c << n, t, r.x() * n.y() - r.y() * n.x(), r.x() * t.y() - r.y() * t.x();
  return c;
}
Eigen::Matrix<double, 6, 4> columns(const Contact<3>& contact) {
  Eigen::Matrix3d frame;
  frame << contact.normal, tangents(contact.normal);
  Eigen::Matrix<double, 6, 4> c = Eigen::Matrix<double, 6, 4>::Zero();
  c.topLeftCorner<3, 3>() = frame;
  for (int k = 0; k < 3; ++k) c.col(k).tail<3>() = contact.position.cross(frame.col(k));
  c.col(3).tail<3>() = contact.normal;
  return c;
}

}  // namespace

// Duff et al., Building an orthonormal basis, revisited (2017): no normal is special.
Eigen::Matrix<double, 3, 2> tangents(const Vector<3>& n) {
  const double sign = std::copysign(1, n.z()), a = -1 / (sign + n.z()), b = n.x() * n.y() * a;
  Eigen::Matrix<double, 3, 2> t;
  t << 1 + sign * n.x() * n.x() * a, b,    //
      sign * b, sign + n.y() * n.y() * a,  //
      -sign * n.x(), -n.y();
  return t;
}

template <int Dim>
Hand<Dim>::Hand(std::vector<Contact<Dim>> contacts, const Vector<Dim>& center, double safety)
    : contacts_(std::move(contacts)), center_(center) {
  check<Dim>(center, {"center"});
  check(safety, safety >= 1, {"safety"}, "at least 1");
  if (contacts_.empty()) throw InvalidGrasp("contacts", "is empty, must hold at least one contact");
  fingers_.reserve(contacts_.size());
  finger_of_.reserve(contacts_.size());
  std::map<std::string_view, std::size_t> labels;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    Contact<Dim>& contact = contacts_[i];
    check<Dim>(contact, i);
    contact.normal = unit<Dim>(contact.normal);
    contact.friction /= safety;
    contact.torsion /= safety;
    const double distance = (contact.position - center_).norm();
    if (!std::isfinite(distance))
      throw InvalidGrasp(Place{"position", i}.path(), "is too far from the centre of mass");
    radius_ = std::max(radius_, distance);
    const bool own = contact.finger.empty();  // a finger of its own, named after the contact
    if (own) contact.finger = std::to_string(i);
    const std::size_t finger =
        own ? fingers_.size() : labels.try_emplace(contact.finger, fingers_.size()).first->second;
    finger_of_.push_back(finger);
    if (finger == fingers_.size()) fingers_.push_back(contact.finger);
  }
  // The solver squares the moment of a soft finger beside the force at the radius.
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    check(contacts_[i].torsion,
          contacts_[i].torsion <= 1e12 * contacts_[i].friction * (radius_ > 0 ? radius_ : 1),
          {"torsion", i}, "at most 1e12 times friction times the size of the grasp");
  scaled_ = std::make_shared<const Scaled>(contacts_, center_, radius_);
}

template <int Dim>
Wrench<Dim> Load<Dim>::at(const Vector<Dim>& up) const {
  const Vector<Dim> force = weight * up;
  Wrench<Dim> load;
  if constexpr (Dim == 2)
    load << force, com.x() * force.y() - com.y() * force.x();
  else
    load << force, com.cross(force);
  return load + fixed;
}

template <int Dim>
template <std::same_as<std::vector<Load<Dim>>> Loads>
Grasp<Dim>::Grasp(Loads loads, std::vector<Contact<Dim>> contacts, double safety)
    : Hand<Dim>(std::move(contacts), checked(loads).front().com, safety), loads_(std::move(loads)) {
  for (const Load<Dim>& load : loads_) weight_ = std::max(weight_, load.weight);
}

template <int Dim>
Grasp<Dim>::Grasp(const Load<Dim>& load, std::vector<Contact<Dim>> contacts, double safety)
    : Grasp(std::vector<Load<Dim>>{load}, std::move(contacts), safety) {}

template <int Dim>
Eigen::Matrix<double, wrench_size<Dim>, Eigen::Dynamic> grasp_matrix(const Hand<Dim>& hand) {
  const auto& contacts = hand.contacts();
  constexpr int width = contact_size<Dim>;
  Eigen::Matrix<double, wrench_size<Dim>, Eigen::Dynamic> G(
      wrench_size<Dim>, width * static_cast<int>(contacts.size()));
  for (std::size_t i = 0; i < contacts.size(); ++i)
    G.template middleCols<width>(width * static_cast<int>(i)) = columns(contacts[i]);
  return G;
}

template class Hand<2>;
template class Hand<3>;
template struct Load<2>;
template struct Load<3>;
template class Grasp<2>;
template class Grasp<3>;
template Grasp<2>::Grasp(std::vector<Load<2>>, std::vector<Contact<2>>, double);
template Grasp<3>::Grasp(std::vector<Load<3>>, std::vector<Contact<3>>, double);
template Eigen::Matrix<double, 3, Eigen::Dynamic> grasp_matrix<2>(const Hand<2>&);
template Eigen::Matrix<double, 6, Eigen::Dynamic> grasp_matrix<3>(const Hand<3>&);

}  // namespace poise
