// Random grasps in space, for benchmarks.
#pragma once

#include <random>

#include "poise/hold.hpp"

namespace poise {

inline Vector<3> direction(std::mt19937& random) {
  std::normal_distribution<> normal;
  return Vector<3>(normal(random), normal(random), normal(random)).normalized();
}

/// Contacts on an ellipsoid, their normals up to 17 degrees off, friction 0.3 to 1, torsion 0.05 to
/// 0.2 m where they are soft.
inline Grasp<3> random_grasp(std::mt19937& random, std::size_t contacts, bool soft) {
  std::uniform_real_distribution<> uniform(0, 1);
  std::vector<Contact<3>> all(contacts);
  for (Contact<3>& contact : all) {
    const Vector<3> at = direction(random);
    contact.position = at.cwiseProduct(Vector<3>(1, 1.5, 0.7));
    contact.normal = -(at + 0.3 * direction(random)).normalized();
    contact.friction = 0.3 + 0.7 * uniform(random);
    if (soft) contact.torsion = 0.05 + 0.15 * uniform(random);
  }
  return {Load<3>{.weight = 1, .com = 0.2 * direction(random)}, all};
}

}  // namespace poise
