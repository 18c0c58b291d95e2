// Spatial grasps at random, awkward ones on purpose. RapidCheck shrinks them.
#pragma once

#include <Eigen/Geometry>

#include "random_grasps.hpp"

namespace poise::test {

/// As C++, so that a failure can be pasted into a test.
inline std::ostream& operator<<(std::ostream& out, const Unchecked<3>& held) {
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

namespace space {

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
      complicate(contact, held, recipe);
      held.contacts.push_back(contact);
    }
    return held;
  });
}

/// Two to five fingers round a ball, all on its upper half, whose friction is only just enough.
inline rc::Gen<Held> nearly_unholdable() {
  return rc::gen::exec([] {
    Held held;
    const double phi = real(pi / 6, pi / 2.1);
    const int fingers = pick(2, 5);
    const bool soft = fingers == 2 || one_in(2);
    const double friction = 1 / std::tan(phi) + std::pow(10, -pick(1, 4));
    for (int k = 0; k < fingers; ++k) {
      const Vector<2> out = std::sin(phi) * direction(2 * pi * k / fingers);
      Contact<3> contact;
      contact.position = {out.x(), out.y(), std::cos(phi)};
      contact.normal = -contact.position;
      contact.friction = friction;
      if (soft) contact.torsion = real(0.5, 0.01);
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

}  // namespace space
}  // namespace poise::test
