// A grasp before it is checked, and contacts in one line.
#pragma once

#include <limits>
#include <vector>

#include "poise/grasp.hpp"

namespace poise::test {

/// An object and its contacts before they are checked: what laws can change.
template <int Dim>
struct Unchecked {
  Load<Dim> object;
  std::vector<Contact<Dim>> contacts;

  Grasp<Dim> grasp() const { return Grasp<Dim>(object, contacts); }
};

using Held = Unchecked<2>;

inline Contact<2> contact(const Vector<2>& position, const Vector<2>& normal, double friction,
                          double max_normal = std::numeric_limits<double>::infinity()) {
  Contact<2> result;
  result.position = position;
  result.normal = normal;
  result.friction = friction;
  result.max_normal = max_normal;
  return result;
}

namespace space {

using Held = Unchecked<3>;

inline Contact<3> contact(const Vector<3>& position, const Vector<3>& normal, double friction,
                          double torsion = 0) {
  Contact<3> result;
  result.position = position;
  result.normal = normal;
  result.friction = friction;
  result.torsion = torsion;
  return result;
}

/// The same with all lengths `times` as long.
inline Held enlarged(Held held, double times) {
  held.object.com *= times;
  for (Contact<3>& c : held.contacts) {
    c.position *= times;
    c.torsion *= times;
  }
  return held;
}

}  // namespace space
}  // namespace poise::test
