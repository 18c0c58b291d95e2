// The least grip of pads, tried in a simulator that has friction at points alone.
#include <gtest/gtest.h>

#include <random>

#include "held.hpp"
#include "physics/scene.hpp"
#include "poise/grip.hpp"

namespace poise::test::physics {
namespace {

constexpr double pi = 3.14159265358979323846;
/// What falls freely for so long moves by 0.05 m.
constexpr double seconds = 0.1, slipped = 1e-4;

/// 10 N between two pads, the centre of mass anywhere between them.
space::Held random_pad_jaws(std::mt19937& numbers) {
  const auto real = [&](double lo, double hi) {
    return std::uniform_real_distribution(lo, hi)(numbers);
  };
  const double half = real(0.01, 0.04), friction = real(0.3, 1), turn = real(0, pi);
  const Vector<2> size(real(0.01, 0.03), real(0.01, 0.03));
  space::Held held{{10, {real(-0.8, 0.8) * half, real(-0.01, 0.01), real(-0.01, 0.01)}}, {}};
  for (const double side : {-1.0, 1.0}) {
    Contact<3> pad = space::contact({side * half, 0, 0}, {-side, 0, 0}, friction);
    pad.pad = rectangular_pad(size, {0, std::cos(turn), std::sin(turn)}, pad.normal, 3);
    pad.pad->reach.setZero();
    held.contacts.push_back(pad);
  }
  return held;
}

/// How far the object moves [m] if the points of the pads press with their shares of these forces.
double moved(const space::Held& held, const Vector<3>& up, const std::array<double, 2>& normal) {
  space::Held points{held.object, {}};
  std::vector<double> forces;
  for (std::size_t i = 0; i < 2; ++i) {
    const Contact<3>& contact = held.contacts[i];
    for (std::size_t k = 0; k < contact.pad->points.size(); ++k) {
      points.contacts.push_back(space::contact(contact.position + contact.pad->points[k],
                                               contact.normal, contact.friction));
      forces.push_back(contact.pad->shares[k] * normal[i]);
    }
  }
  return Scene(points.grasp(), up, forces, 1).moved(seconds);
}

// What is asserted is the model of a pad but for its centre of pressure: a normal force that is
// spread evenly, and friction at each point by its share. So each point is pressed by a drive of
// its own. A rigid pad on one drive would let the simulator choose the pressure, and with it where
// friction is: then it slips, or holds, a tenth or more beside F*.
TEST(Pads, WithEvenPressureHoldJustAboveTheLeastGripAndSlipBelow) {
  std::mt19937 numbers(1);
  std::uniform_real_distribution coordinate(-1.0, 1.0);
  for (int tried = 0; tried < 50;) {
    const space::Held held = random_pad_jaws(numbers);
    const Vector<3> up =
        Vector<3>(coordinate(numbers), coordinate(numbers), coordinate(numbers)).normalized();
    const Grasp<3> grasp = held.grasp();
    const Hold<3> found = least_grip(grasp, up);
    ASSERT_TRUE(found.holdable);
    const double F = found.grip, N0 = found.forces[0].normal, N1 = found.forces[1].normal;
    // Their difference is the weight along the jaws.
    const auto at = [&](double part) {
      return moved(held, up, {N0 + (part - 1) * F, N1 + (part - 1) * F});
    };
    if (F > 200 || std::min(N0, N1) < 0.1 * F) continue;
    ++tried;
    EXPECT_LT(at(1.01), slipped) << tried << " at " << F << " N";
    EXPECT_GT(at(0.98), 2 * slipped) << tried << " at " << F << " N";
  }
}

}  // namespace
}  // namespace poise::test::physics
