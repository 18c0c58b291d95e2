// How fast Poise answers, in yardsticks: one yardstick is one Eigen fixed-size 3 x 3 LDLT
// factor-and-solve, timed in turn with what it measures. Each row is the median over seeded random
// grasps; ./dev bench prints them all.
#include <random>

#include "measure.hpp"
#include "poise/best_posture.hpp"

namespace {

using namespace poise;

constexpr double pi = 3.14159265358979323846;

struct Case {
  Grasp<2> grasp;
  Vector<2> up;
  Wrench<2> load;
  Twist<2> neighbour;  ///< the dual one degree away
};

/// Contacts on an ellipse, their normals up to 17 degrees off, friction 0.2 to 1; in a posture
/// where 30 weights of force norm hold it.
Case random_case(std::mt19937& random, std::size_t contacts) {
  std::uniform_real_distribution<> uniform(0, 1);
  while (true) {
    std::vector<Contact<2>> all;
    for (std::size_t i = 0; i < contacts; ++i) {
      const double phi = 2 * pi * uniform(random), width = 1 + uniform(random);
      const double tilt = 0.6 * (uniform(random) - 0.5);
      Contact<2> contact;
      contact.position = {width * std::cos(phi), std::sin(phi)};
      contact.normal = -up_at(pi / 2 - phi + tilt);
      contact.friction = 0.2 + 0.8 * uniform(random);
      all.push_back(contact);
    }
    const Grasp<2> grasp(Load<2>{}, all);
    const double theta = 2 * pi * uniform(random);
    const Hold<2> here = hold(grasp, up_at(theta)), beside = hold(grasp, up_at(theta + pi / 180));
    if (here.holdable && beside.holdable && here.effort < 900)
      return {grasp, up_at(theta), grasp.loads().front().at(up_at(theta)), beside.dual};
  }
}

Grasp<2> paper_disk() {
  const double phi = 5 * pi / 12;
  Load<2> object;
  object.weight = 10;
  std::vector<Contact<2>> contacts(2);
  contacts[0].position = up_at(phi);
  contacts[1].position = up_at(-phi);
  for (Contact<2>& contact : contacts) contact.normal = -contact.position;
  contacts[0].friction = 1;
  contacts[1].friction = 1 / std::sqrt(3.0);
  return {object, contacts};
}

std::vector<Case> random_cases(std::size_t contacts) {
  std::mt19937 random(2026);
  std::vector<Case> cases;
  const std::size_t count = contacts <= 64 ? 1000 : 50;
  while (cases.size() < count) cases.push_back(random_case(random, contacts));
  return cases;
}

void hold_cold(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const std::vector<Case> cases = random_cases(n);
  measure<3>(state, cases.size(), n <= 64 ? 50 : 5,
             [&](std::size_t i) { benchmark::DoNotOptimize(hold(cases[i].grasp, cases[i].up)); });
}

void hold_warm(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const std::vector<Case> cases = random_cases(n);
  measure<3>(state, cases.size(), n <= 64 ? 50 : 5, [&](std::size_t i) {
    const Case& c = cases[i];
    benchmark::DoNotOptimize(hold(c.grasp, c.load, 1, c.neighbour));
  });
}

/// From contacts to a grasp that is checked, scaled and factorised.
void make(benchmark::State& state) {
  std::vector<Case> cases = random_cases(static_cast<std::size_t>(state.range(0)));
  std::vector<std::vector<Contact<2>>> contacts;
  for (const Case& c : cases) {
    contacts.push_back(c.grasp.contacts());
    for (Contact<2>& contact : contacts.back()) contact.finger.clear();
  }
  measure<3>(state, cases.size(), 50,
             [&](std::size_t i) { benchmark::DoNotOptimize(Grasp<2>(Load<2>{}, contacts[i])); });
}

void curve(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const std::vector<Case> cases = random_cases(n);
  measure<3>(state, cases.size(), n <= 8 ? 10 : 1,
             [&](std::size_t i) { benchmark::DoNotOptimize(posture_curve(cases[i].grasp)); });
}

void curve_of_the_papers_disk(benchmark::State& state) {
  const Grasp<2> disk = paper_disk();
  measure<3>(state, 1, 20, [&](std::size_t) { benchmark::DoNotOptimize(posture_curve(disk)); });
}

BENCHMARK(hold_cold)
    ->UseManualTime()
    ->Iterations(1000)
    ->Arg(2)
    ->Arg(3)
    ->Arg(4)
    ->Arg(8)
    ->Arg(16)
    ->Arg(64);
BENCHMARK(hold_cold)->UseManualTime()->Iterations(100)->Arg(256)->Arg(1024);
BENCHMARK(hold_warm)
    ->UseManualTime()
    ->Iterations(1000)
    ->Arg(2)
    ->Arg(3)
    ->Arg(4)
    ->Arg(8)
    ->Arg(16)
    ->Arg(64);
BENCHMARK(hold_warm)->UseManualTime()->Iterations(100)->Arg(256)->Arg(1024);
BENCHMARK(make)->UseManualTime()->Iterations(1000)->Arg(2)->Arg(4)->Arg(8);
BENCHMARK(curve_of_the_papers_disk)->UseManualTime()->Iterations(1000);
BENCHMARK(curve)->UseManualTime()->Iterations(1000)->Arg(2)->Arg(3)->Arg(4)->Arg(8)->Arg(16);
BENCHMARK(curve)->UseManualTime()->Iterations(100)->Arg(64);

}  // namespace

BENCHMARK_MAIN();
