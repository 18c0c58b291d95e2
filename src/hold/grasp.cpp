#include "poise/grasp.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "dual/scaled_grasp.hpp"

namespace poise {
namespace {

std::string text(double value) {
  std::ostringstream out;
  out.precision(12);
  out << value;
  return out.str();
}

/// Throws unless `value` is finite with a finite square, and `in_range`.
void check(double value, bool in_range, const std::string& path, const std::string& expected) {
  if (!std::isfinite(value) || !std::isfinite(value * value) || !in_range)
    throw InvalidGrasp(path, "is " + text(value) + ", must be " + expected);
}

template <int Dim>
void check(const Vector<Dim>& value, const std::string& path) {
  for (int k = 0; k < Dim; ++k)
    check(value[k], true, path + "[" + std::to_string(k) + "]", "a finite number");
  if (!std::isfinite(value.squaredNorm()))
    throw InvalidGrasp(path, "is too long: its square overflows");
}

template <int Dim>
void check(const Contact<Dim>& contact, const std::string& path) {
  check<Dim>(contact.position, path + ".position");
  check<Dim>(contact.normal, path + ".normal");
  if (!(contact.normal.stableNorm() > 0))
    throw InvalidGrasp(path + ".normal", "has no length, must point from the finger inwards");
  check(contact.friction, contact.friction >= 0, path + ".friction", "at least 0");
  check(contact.min_normal, contact.min_normal >= 0, path + ".min_normal", "at least 0");
  const double max = contact.max_normal;
  if (max != std::numeric_limits<double>::infinity())
    check(max, max >= 0, path + ".max_normal", "at least 0");
  if (max < contact.min_normal)
    throw InvalidGrasp(path + ".max_normal", "is " + text(max) + ", must be at least min_normal, " +
                                                 text(contact.min_normal));
  check(contact.share, contact.share > 0 && contact.share <= 1, path + ".share",
        "above 0 and at most 1");
  const double torsion = contact.torsion;
  if (Dim == 2) check(torsion, torsion == 0, path + ".torsion", "0 in the plane");
  check(torsion, torsion >= 0, path + ".torsion", "at least 0");
  check(torsion, torsion == 0 || contact.friction > 0, path + ".torsion",
        "0 where there is no friction");
  // The solver divides by it.
  check(torsion > 0 ? contact.friction / torsion : 0, true, path + ".torsion",
        "less small against the friction");
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
Grasp<Dim>::Grasp(const Object<Dim>& object, std::vector<Contact<Dim>> contacts, double safety)
    : object_(object), contacts_(std::move(contacts)) {
  check(object_.weight, object_.weight > 0, "object.weight", "above 0");
  check<Dim>(object_.com, "object.com");
  check(safety, safety >= 1, "safety", "at least 1");
  if (contacts_.empty()) throw InvalidGrasp("contacts", "is empty, must hold at least one contact");
  std::map<std::string, std::size_t> labels;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    Contact<Dim>& contact = contacts_[i];
    const std::string path = "contacts[" + std::to_string(i) + "]";
    check<Dim>(contact, path);
    contact.normal = contact.normal.stableNormalized();
    contact.friction /= safety;
    contact.torsion /= safety;
    const double distance = (contact.position - object_.com).norm();
    if (!std::isfinite(distance))
      throw InvalidGrasp(path + ".position", "is too far from the centre of mass");
    radius_ = std::max(radius_, distance);
    const bool own = contact.finger.empty();  // a finger of its own, named after the contact
    const auto label = own ? labels.end() : labels.find(contact.finger);
    finger_of_.push_back(label == labels.end() ? fingers_.size() : label->second);
    if (label != labels.end()) continue;
    if (own)
      contact.finger = std::to_string(i);
    else
      labels.emplace(contact.finger, fingers_.size());
    fingers_.push_back(contact.finger);
  }
  // The solver squares the moment of a soft finger beside the force at the radius.
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    check(contacts_[i].torsion,
          contacts_[i].torsion <= 1e12 * contacts_[i].friction * (radius_ > 0 ? radius_ : 1),
          "contacts[" + std::to_string(i) + "].torsion",
          "at most 1e12 times friction times the size of the grasp");
  scaled_ = std::make_shared<const ScaledGrasp<Dim>>(*this);
}

template <int Dim>
Wrench<Dim> Grasp<Dim>::load(const Vector<Dim>& up) const {
  const Vector<Dim> force = object_.weight * up, &com = object_.com;
  Wrench<Dim> load;
  if constexpr (Dim == 2)
    load << force, com.x() * force.y() - com.y() * force.x();
  else
    load << force, com.cross(force);
  return load;
}

template <int Dim>
Eigen::Matrix<double, wrench_size<Dim>, Eigen::Dynamic> grasp_matrix(const Grasp<Dim>& grasp) {
  const auto& contacts = grasp.contacts();
  constexpr int width = contact_size<Dim>;
  Eigen::Matrix<double, wrench_size<Dim>, Eigen::Dynamic> G(
      wrench_size<Dim>, width * static_cast<int>(contacts.size()));
  for (std::size_t i = 0; i < contacts.size(); ++i)
    G.template middleCols<width>(width * static_cast<int>(i)) = columns(contacts[i]);
  return G;
}

template class Grasp<2>;
template class Grasp<3>;
template Eigen::Matrix<double, 3, Eigen::Dynamic> grasp_matrix<2>(const Grasp<2>&);
template Eigen::Matrix<double, 6, Eigen::Dynamic> grasp_matrix<3>(const Grasp<3>&);

}  // namespace poise
