// Planar grasps at random, awkward ones on purpose. RapidCheck shrinks them.
#pragma once

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdlib>
#include <ostream>

#include "held.hpp"
#include "poise/posture.hpp"

namespace poise::test {

inline constexpr double pi = 3.14159265358979323846;

/// The same grasps in every run, unless RC_PARAMS asks for others.
inline const int fixed_seed = setenv("RC_PARAMS", "seed=20 max_success=2000", 0);

/// As C++, so that a failure can be pasted into a test.
inline std::ostream& operator<<(std::ostream& out, const Held& held) {
  out.precision(17);
  out << "{{" << held.object.weight << ", {" << held.object.com.x() << ", " << held.object.com.y()
      << "}}, {";
  for (const Contact<2>& c : held.contacts)
    out << "\n  {{" << c.position.x() << ", " << c.position.y() << "}, {" << c.normal.x() << ", "
        << c.normal.y() << "}, " << c.friction << ", " << c.min_normal << ", " << c.max_normal
        << ", " << c.share << "},";
  return out << "}}";
}

/// What random grasps may be like.
struct Recipe {
  int least_contacts{1}, most_contacts{8};
  bool limits{true};
  bool awkward{true};  ///< thin cones, coinciding contacts, contacts at the com, ...
};

/// Only inside rc::gen::exec and properties. All shrink towards the first of the range.
inline int pick(int from, int to) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(from, to + 1));
}
inline bool one_in(int n) { return pick(1, n) == n; }
inline double real(double from, double to) { return from + (to - from) * pick(0, 10000) / 10000; }
/// In [-1, 1], shrinking towards 0.
inline double coordinate() {
  const int k = pick(0, 20000), steps = (k + 1) / 2;
  return (k % 2 == 0 ? steps : -steps) / 10000.0;
}
inline Vector<2> direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// A posture, often one in which symmetric grasps change.
inline double random_angle() { return one_in(4) ? pi / 12 * pick(-11, 12) : pi * coordinate(); }

inline double random_friction(bool awkward) {
  switch (pick(0, awkward ? 4 : 0)) {
    case 1:
      return 0;
    case 2:
      return 1e-3;
    case 3:
      return std::tan(pi / 12 * pick(1, 5));
    default:
      return real(0.1, 2);
  }
}

inline Contact<2> random_contact(int family) {
  Contact<2> contact;
  if (family == 0) {  // anywhere, any way
    contact.position = {coordinate(), coordinate()};
    contact.normal = direction(pi * coordinate());
  } else {  // round a disk, in any place or on a grid
    const double at = family == 1 ? pi * coordinate() : pi / 6 * pick(0, 11);
    contact.position = direction(at);
    contact.normal = -direction(at);
  }
  return contact;
}

/// Adds share and limits, and what is degenerate on purpose.
template <int Dim>
void complicate(Contact<Dim>& contact, const Unchecked<Dim>& held, const Recipe& recipe) {
  if (one_in(4)) contact.share = real(1, 0.05);
  if (recipe.limits && one_in(3)) contact.min_normal = held.object.weight * real(0, 0.5);
  if (recipe.limits && one_in(3))
    contact.max_normal = contact.min_normal + held.object.weight * real(2, 0);
  if (!recipe.awkward) return;
  if (one_in(12) && !held.contacts.empty()) contact.position = held.contacts.back().position;
  if (one_in(16)) contact.position = held.object.com;
  if (one_in(12)) contact.normal = -contact.normal;
}

/// A disk between two fingers whose friction is only just enough.
inline rc::Gen<Held> nearly_unholdable() {
  return rc::gen::exec([] {
    Held held;
    const double phi = real(pi / 6, pi / 2.1);
    for (const double side : {1.0, -1.0}) {
      Contact<2> contact;
      contact.position = {side * std::sin(phi), std::cos(phi)};
      contact.normal = -contact.position;
      contact.friction = 1 / std::tan(phi) + std::pow(10, -pick(1, 4));
      held.contacts.push_back(contact);
    }
    return held;
  });
}

inline rc::Gen<Held> grasps(Recipe recipe = {}) {
  return rc::gen::exec([recipe] {
    const bool awkward = recipe.awkward;
    Held held;
    held.object.weight = one_in(2) ? 10 : 1;
    const int family = pick(0, awkward ? 2 : 1);
    if (!awkward || one_in(2)) held.object.com = {0.5 * coordinate(), 0.5 * coordinate()};
    const bool mirrored = awkward && one_in(5);
    const auto count = static_cast<std::size_t>(pick(recipe.least_contacts, recipe.most_contacts));
    while (held.contacts.size() < count) {
      Contact<2> contact = random_contact(family);
      contact.friction = random_friction(awkward);
      complicate(contact, held, recipe);
      held.contacts.push_back(contact);
      if (!mirrored || held.contacts.size() == count) continue;
      contact.position.x() *= -1;
      contact.normal.x() *= -1;
      held.contacts.push_back(contact);
    }
    if (mirrored) held.object.com.x() = 0;
    return held;
  });
}

/// A load with accelerations and a fixed wrench, or without; at times without weight.
inline Load<2> random_load() {
  Load<2> load;
  load.weight = one_in(4) ? 0 : real(1, 10);
  load.com = {0.5 * coordinate(), 0.5 * coordinate()};
  if (one_in(3)) load.lift = 15 * coordinate();
  if (one_in(3)) load.acceleration = {5 * coordinate(), 5 * coordinate()};
  if (one_in(3) || load.weight == 0)
    load.fixed = {3 * coordinate(), real(1, 4), one_in(2) ? coordinate() : 0};
  return load;
}
inline std::vector<Load<2>> random_loads(int most) {
  std::vector<Load<2>> loads;
  const int count = pick(1, most);
  while (static_cast<int>(loads.size()) < count) loads.push_back(random_load());
  return loads;
}

}  // namespace poise::test
