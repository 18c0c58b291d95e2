// Spatial grasps at random, awkward ones on purpose. RapidCheck shrinks them.
#pragma once

#include <Eigen/Geometry>

#include "random_grasps.hpp"

namespace poise::test::space {

/// An object and its contacts before they are checked: what laws can change.
struct Held {
  Object<3> object;
  std::vector<Contact<3>> contacts;

  Grasp<3> grasp() const { return Grasp<3>(object, contacts); }
};

/// As C++, so that a failure can be pasted into a test.
inline std::ostream& operator<<(std::ostream& out, const Held& held) {
  const auto text = [&](const Vector<3>& v) {
    out << "{" << v.x() << ", " << v.y() << ", " << v.z() << "}";
  };
  out.precision(17);
  out << "{{" << held.object.weight << ", ";
  text(held.object.com);
  out << "}, {";
  for (const Contact<3>& c : held.contacts) {
    out << "\n  {";
    text(c.position);
    out << ", ";
    text(c.normal);
    out << ", " << c.friction << ", " << c.min_normal << ", " << c.max_normal << ", " << c.share
        << ", \"\", " << c.torsion << "},";
  }
  return out << "}}";
}

/// A unit vector, often along the axes or in a plane of them.
inline Vector<3> random_direction() {
  if (one_in(5)) return Vector<3>::Unit(pick(0, 2)) * (one_in(2) ? -1 : 1);
  Vector<3> v(coordinate(), coordinate(), coordinate());
  if (one_in(6)) v[pick(0, 2)] = 0;
  return v.norm() > 1e-3 ? Vector<3>(v.normalized()) : Vector<3>(0, 0, 1);
}

inline Contact<3> random_contact(int family, bool awkward) {
  Contact<3> contact;
  contact.position = random_direction();
  contact.normal = -contact.position;
  if (family == 0) {  // anywhere, any way
    contact.position = {coordinate(), coordinate(), coordinate()};
    contact.normal = random_direction();
  }
  contact.friction = random_friction(awkward);
  if (contact.friction > 0 && one_in(3)) contact.torsion = one_in(4) ? 1e-3 : real(0.5, 0.01);
  return contact;
}

inline rc::Gen<Held> grasps(Recipe recipe = {}) {
  return rc::gen::exec([recipe] {
    const bool awkward = recipe.awkward;
    Held held;
    held.object.weight = one_in(2) ? 10 : 1;
    const int family = pick(0, 1);
    if (!awkward || one_in(2))
      held.object.com = 0.5 * Vector<3>(coordinate(), coordinate(), coordinate());
    const auto count = static_cast<std::size_t>(pick(recipe.least_contacts, recipe.most_contacts));
    while (held.contacts.size() < count) {
      Contact<3> contact = random_contact(family, awkward);
      if (one_in(4)) contact.share = real(1, 0.05);
      if (recipe.limits && one_in(3)) contact.min_normal = held.object.weight * real(0, 0.5);
      if (recipe.limits && one_in(3))
        contact.max_normal = contact.min_normal + held.object.weight * real(2, 0);
      if (awkward) {
        if (one_in(12) && !held.contacts.empty()) contact.position = held.contacts.back().position;
        if (one_in(16)) contact.position = held.object.com;
        if (one_in(12)) contact.normal = -contact.normal;
      }
      held.contacts.push_back(contact);
    }
    return held;
  });
}

inline Eigen::Matrix3d random_rotation() {
  return Eigen::Quaterniond(
             Eigen::Vector4d(coordinate(), coordinate(), coordinate(), 0.1 + real(0, 1))
                 .normalized())
      .toRotationMatrix();
}

/// The grasp in a frame turned by R and moved by `by`.
inline Held moved(Held held, const Eigen::Matrix3d& R, const Vector<3>& by) {
  held.object.com = R * held.object.com + by;
  for (Contact<3>& c : held.contacts) {
    c.position = R * c.position + by;
    c.normal = R * c.normal;
  }
  return held;
}

}  // namespace poise::test::space
