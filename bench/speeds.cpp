// What a hold, a curve and a best posture take, in nanoseconds: compiled for the machine and as
// WebAssembly, for ./dev bench to compare.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#include "poise/best_posture.hpp"

namespace {

using namespace poise;

constexpr double pi = 3.14159265358979323846;

/// Fingers around a disk, all above its middle.
Grasp<2> disk(int fingers) {
  std::vector<Contact<2>> contacts(static_cast<std::size_t>(fingers));
  for (int i = 0; i < fingers; ++i) {
    Contact<2>& contact = contacts[static_cast<std::size_t>(i)];
    contact.position = up_at(pi * (1.0 + 0.9 * i / fingers));
    contact.normal = -contact.position;
    contact.friction = 0.7 + 0.05 * i;
  }
  return {Load<2>{.weight = 10, .com = {0.1, 0.05}}, contacts};
}

/// Fingers around a cylinder, above its middle.
Grasp<3> cylinder(int fingers) {
  std::vector<Contact<3>> contacts(static_cast<std::size_t>(fingers));
  for (int i = 0; i < fingers; ++i) {
    Contact<3>& contact = contacts[static_cast<std::size_t>(i)];
    contact.normal = {-std::cos(2 * pi * i / fingers), -std::sin(2 * pi * i / fingers), 0};
    contact.position = Vector<3>(0, 0, 0.4) - contact.normal;
    contact.friction = 0.5 + 0.05 * i;
  }
  return {Load<3>{.weight = 10, .com = {0.1, 0.05, 0}}, contacts};
}

/// The fastest of several rounds, each of some milliseconds.
template <class Call>
void report(const char* name, const Call& call) {
  using Clock = std::chrono::steady_clock;
  const auto seconds = [&](int calls) {
    const auto start = Clock::now();
    for (int k = 0; k < calls; ++k) call(k);
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  int calls = 1;
  while (seconds(calls) < 2e-2) calls *= 2;
  double best = seconds(calls);
  for (int round = 0; round < 9; ++round) best = std::min(best, seconds(calls));
  std::printf("%s\t%.1f\n", name, 1e9 * best / calls);
}

double sink;  ///< what is found here is not optimised away

template <int Dim>
void report_hold(const char* name, const Grasp<Dim>& grasp, const std::vector<Vector<Dim>>& ups) {
  report(name,
         [&](int k) { sink = hold(grasp, ups[static_cast<std::size_t>(k) % ups.size()]).effort; });
}

}  // namespace

int main() {
  std::vector<Vector<2>> in_plane;
  std::vector<Vector<3>> in_space;
  for (int k = 0; k < 64; ++k) {
    in_plane.push_back(up_at(0.02 * (k - 32)));
    in_space.push_back(Vector<3>(0.3 * std::sin(k), 0.3 * std::cos(2 * k), 1).normalized());
  }
  report_hold<2>("hold, 2 contacts in the plane", disk(2), in_plane);
  report_hold<2>("hold, 4 contacts in the plane", disk(4), in_plane);
  report_hold<3>("hold, 3 contacts in space", cylinder(3), in_space);
  report_hold<3>("hold, 8 contacts in space", cylinder(8), in_space);
  for (const int fingers : {2, 4}) {
    const Grasp<2> grasp = disk(fingers);
    const char* name = fingers == 2 ? "posture_curve, 2 contacts" : "posture_curve, 4 contacts";
    report(name, [&](int) { sink = posture_curve(grasp).arcs.front().value.c0; });
  }
  const Grasp<2> planar = disk(2);
  report("best in the plane, 2 contacts", [&](int) { sink = best_posture(planar).lower_bound; });
  const Grasp<3> spatial = cylinder(3);
  report("best in space, 3 contacts", [&](int) { sink = best_posture(spatial).lower_bound; });
}
