// How fast Poise answers in space, in yardsticks: one yardstick is one Eigen fixed-size 6 x 6 LDLT
// factor-and-solve. Each row is the median over seeded random grasps, p95 their 95th percentile.
#include <Eigen/Geometry>
#include <random>

#include "measure.hpp"
#include "poise/best_posture.hpp"
#include "poise/grip.hpp"
#include "poise/turn.hpp"
#include "space_cases.hpp"

namespace {

using namespace poise;

struct Case {
  Grasp<3> grasp;
  Vector<3> up;
  Wrench<3> load;
  Twist<3> neighbour;  ///< the dual one degree away
};

/// In a posture where 30 weights of force norm hold it.
std::vector<Case> random_cases(std::size_t contacts, bool soft, std::size_t count) {
  std::mt19937 random(2026);
  std::vector<Case> cases;
  while (cases.size() < count) {
    const Grasp<3> grasp = random_grasp(random, contacts, soft);
    const Vector<3> up = direction(random);
    const Vector<3> across = up.cross(direction(random)).normalized();
    const Vector<3> beside = (up + std::tan(3.14159265358979 / 180) * across).normalized();
    const Hold<3> here = hold(grasp, up), there = hold(grasp, beside);
    if (here.holdable && there.holdable && here.effort < 900)
      cases.push_back({grasp, up, grasp.loads().front().at(up), there.dual});
  }
  return cases;
}

std::vector<Case> random_cases(std::size_t contacts, bool soft) {
  return random_cases(contacts, soft, contacts <= 64 ? 1000 : 20);
}

std::vector<Grasp<3>> random_grasps(std::size_t contacts, bool soft, std::size_t count = 1000) {
  std::mt19937 random(2026);
  std::vector<Grasp<3>> grasps;
  while (grasps.size() < count) grasps.push_back(random_grasp(random, contacts, soft));
  return grasps;
}

int calls(std::size_t contacts) { return contacts <= 64 ? 20 : 2; }

void space_hold_cold(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const std::vector<Case> cases = random_cases(n, state.range(1) == 1);
  measure<6>(state, cases.size(), calls(n),
             [&](std::size_t i) { benchmark::DoNotOptimize(hold(cases[i].grasp, cases[i].up)); });
}

void space_hold_warm(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const std::vector<Case> cases = random_cases(n, state.range(1) == 1);
  measure<6>(state, cases.size(), calls(n), [&](std::size_t i) {
    const Case& c = cases[i];
    benchmark::DoNotOptimize(hold(c.grasp, c.load, 1, c.neighbour));
  });
}

/// The least grip of the same cases, a drive for each finger.
void space_grip(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const std::vector<Case> cases = random_cases(n, state.range(1) == 1, 200);
  measure<6>(state, cases.size(), 5, [&](std::size_t i) {
    benchmark::DoNotOptimize(least_grip(cases[i].grasp, cases[i].up));
  });
}

/// The certified posture of least grip alone.
void space_best_grip(benchmark::State& state) {
  const std::vector<Grasp<3>> grasps =
      random_grasps(static_cast<std::size_t>(state.range(0)), state.range(1) == 1, 100);
  const SpatialSettings settings{.objective = Objective::grip, .starts = 0};
  std::vector<double> holds;
  for (const Grasp<3>& grasp : grasps) holds.push_back(best_posture(grasp, settings).proof.holds);
  measure<6>(state, grasps.size(), 1,
             [&](std::size_t i) { benchmark::DoNotOptimize(best_posture(grasps[i], settings)); });
  state.counters["holds"] = median(holds);
}

/// Of 2000 grasps, to tell how much more the rare slow holds take.
void space_hold_warm_mean(benchmark::State& state) {
  const std::vector<Case> cases =
      random_cases(static_cast<std::size_t>(state.range(0)), false, 2000);
  measure<6>(
      state, cases.size(), 10,
      [&](std::size_t i) {
        const Case& c = cases[i];
        benchmark::DoNotOptimize(hold(c.grasp, c.load, 1, c.neighbour));
      },
      5);
}

/// From contacts to a grasp that is checked, scaled and factorised.
void space_make(benchmark::State& state) {
  const std::vector<Case> cases =
      random_cases(static_cast<std::size_t>(state.range(0)), state.range(1) == 1);
  std::vector<std::vector<Contact<3>>> contacts;
  for (const Case& c : cases) {
    contacts.push_back(c.grasp.contacts());
    for (Contact<3>& contact : contacts.back()) contact.finger.clear();
  }
  measure<6>(state, cases.size(), 20, [&](std::size_t i) {
    benchmark::DoNotOptimize(Grasp<3>(cases[i].grasp.loads().front(), contacts[i]));
  });
}

/// The certified optimum alone, to a gap of 10^-digits. Outside: the part of the time that is not
/// spent on holds, if a hold takes as long as one of the best posture from its neighbour's y.
void space_best(benchmark::State& state) {
  const std::vector<Grasp<3>> grasps =
      random_grasps(static_cast<std::size_t>(state.range(0)), state.range(1) == 1);
  SpatialSettings settings;
  settings.gap = std::pow(10.0, -static_cast<double>(state.range(2)));
  settings.starts = 0;
  std::vector<double> holds, outside;
  for (const Grasp<3>& grasp : grasps) {
    Best<3> best;
    const double whole = seconds([&] { best = best_posture(grasp, settings); }, 1);
    holds.push_back(best.proof.holds);
    if (!best.holdable()) continue;
    const Wrench<3> load = grasp.loads().front().at(best.best().up);
    const Twist<3> y =
        hold(grasp, (best.best().up + Vector<3>(0.03, 0.02, 0.01)).normalized()).dual;
    const double one = seconds([&] { benchmark::DoNotOptimize(hold(grasp, load, 1, y)); }, 10);
    outside.push_back(1 - best.proof.holds * one / whole);
  }
  measure<6>(state, grasps.size(), 1,
             [&](std::size_t i) { benchmark::DoNotOptimize(best_posture(grasps[i], settings)); });
  state.counters["holds"] = median(holds);
  state.counters["holds_p95"] = quantile(holds, 0.95);
  state.counters["outside"] = median(outside);
}

/// With the list of local minima.
void space_best_and_minima(benchmark::State& state) {
  const std::vector<Grasp<3>> grasps =
      random_grasps(static_cast<std::size_t>(state.range(0)), state.range(1) == 1);
  measure<6>(state, grasps.size(), 1,
             [&](std::size_t i) { benchmark::DoNotOptimize(best_posture(grasps[i])); });
}

/// The turn from a random posture to the best one, by grip: the peak of the straight one, the way
/// of least peak, and what can be reached without pressing harder.
enum class Of { peak, way, reach };
template <Of of>
void space_turn(benchmark::State& state) {
  const std::vector<Grasp<3>> grasps =
      random_grasps(static_cast<std::size_t>(state.range(0)), state.range(1) == 1, 100);
  const TurnSettings settings{.objective = Objective::grip};
  std::vector<Vector<3>> from, to;
  for (const Grasp<3>& grasp : grasps) {
    const Best<3> best = best_posture(grasp, {.objective = Objective::grip, .starts = 0});
    to.push_back(best.holdable() ? best.best().up : Vector<3>(Vector<3>::UnitX()));
    from.push_back(Vector<3>(-0.48, 0.6, 0.64));
    for (const Vector<3>& up : {Vector<3>(0, 0, 1), Vector<3>(0.6, 0, 0.8), Vector<3>(0, 1, 0)})
      if (!hold(grasp, from.back()).holdable) from.back() = up;
    if (!hold(grasp, from.back()).holdable) from.back() = to.back();
  }
  measure<6>(state, grasps.size(), 1, [&](std::size_t i) {
    if constexpr (of == Of::peak)
      benchmark::DoNotOptimize(turn_peak(grasps[i], from[i], to[i], settings));
    else if constexpr (of == Of::way)
      benchmark::DoNotOptimize(least_peak_way(grasps[i], from[i], to[i], settings));
    else if (hold(grasps[i], from[i]).holdable)
      benchmark::DoNotOptimize(best_reachable(grasps[i], from[i], to[i], settings));
  });
}

void holds(benchmark::internal::Benchmark* row) {
  row->UseManualTime()->ArgNames({"contacts", "soft"});
}
BENCHMARK(space_hold_cold)
    ->Apply(holds)
    ->Iterations(1000)
    ->ArgsProduct({{3, 4, 8, 16, 64}, {0, 1}});
BENCHMARK(space_hold_cold)->Apply(holds)->Iterations(40)->ArgsProduct({{256, 4096}, {0, 1}});
BENCHMARK(space_hold_warm)
    ->Apply(holds)
    ->Iterations(1000)
    ->ArgsProduct({{3, 4, 8, 16, 64}, {0, 1}});
BENCHMARK(space_hold_warm)->Apply(holds)->Iterations(40)->ArgsProduct({{256, 4096}, {0, 1}});
BENCHMARK(space_hold_warm_mean)
    ->UseManualTime()
    ->ArgName("contacts")
    ->Iterations(2000)
    ->Arg(3)
    ->Arg(4);
BENCHMARK(space_grip)->Apply(holds)->Iterations(200)->ArgsProduct({{3, 4, 8}, {0, 1}});
BENCHMARK(space_best_grip)->Apply(holds)->Iterations(100)->ArgsProduct({{4, 8}, {0, 1}});
BENCHMARK(space_turn<Of::peak>)->Apply(holds)->Iterations(100)->ArgsProduct({{4, 8}, {0, 1}});
BENCHMARK(space_turn<Of::way>)->Apply(holds)->Iterations(100)->ArgsProduct({{4, 8}, {0, 1}});
BENCHMARK(space_turn<Of::reach>)->Apply(holds)->Iterations(100)->ArgsProduct({{4, 8}, {0, 1}});
BENCHMARK(space_make)->Apply(holds)->Iterations(1000)->ArgsProduct({{4, 8}, {0, 1}});
BENCHMARK(space_best)
    ->UseManualTime()
    ->ArgNames({"contacts", "soft", "digits"})
    ->Iterations(1000)
    ->ArgsProduct({{3, 4, 5, 6, 7, 8}, {0, 1}, {6}})
    ->ArgsProduct({{4}, {0}, {3, 4, 5, 7, 8, 9}});
BENCHMARK(space_best_and_minima)
    ->UseManualTime()
    ->ArgNames({"contacts", "soft"})
    ->Iterations(100)
    ->ArgsProduct({{4, 8}, {0, 1}});

}  // namespace
