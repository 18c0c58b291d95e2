// What loads, shaking and motions take, in what a hold, or the best posture for one load, of the
// same grasps takes in the same run: `ratio` is the median over them.
#include <array>
#include <numbers>

#include "measure.hpp"
#include "poise/best_posture.hpp"
#include "poise/grip.hpp"
#include "poise/motion.hpp"
#include "poise/shake.hpp"
#include "space_cases.hpp"

namespace {

using namespace poise;

/// Times one(i) and other(i) in turn, case after case.
template <class One, class Other>
void compare(benchmark::State& state, std::size_t cases, int calls, const One& one,
             const Other& other) {
  std::vector<double> times, others, ratios;
  for (auto _ : state) {
    const std::size_t i = times.size() % cases;
    times.push_back(seconds([&] { one(i); }, calls));
    others.push_back(seconds([&] { other(i); }, calls));
    ratios.push_back(times.back() / others.back());
    state.SetIterationTime(times.back());
  }
  state.counters["median_ns"] = 1e9 * median(times);
  state.counters["other_ns"] = 1e9 * median(others);
  state.counters["ratio"] = median(ratios);
  state.counters["ratio_p95"] = quantile(ratios, 0.95);
}

struct Case {
  Grasp<3> grasp, changed;
  Vector<3> up;
};

/// Grasps with other loads, in postures where 30 weights of force norm hold both.
template <class Change>
std::vector<Case> cases_with(std::size_t contacts, bool soft, std::size_t count,
                             const Change& change) {
  std::mt19937 random(2026);
  std::vector<Case> cases;
  while (cases.size() < count) {
    const Grasp<3> grasp = random_grasp(random, contacts, soft);
    const Grasp<3> changed(change(random, grasp.loads().front()), grasp.contacts());
    const Vector<3> up = direction(random);
    const Hold<3> one = hold(grasp, up), other = hold(changed, up);
    if (one.holdable && other.holdable && one.effort < 900 && other.effort < 900)
      cases.push_back({grasp, changed, up});
  }
  return cases;
}

/// A hold against the weight and a constant wrench, against one against the weight alone.
void space_hold_with_wrench(benchmark::State& state) {
  const std::vector<Case> cases =
      cases_with(static_cast<std::size_t>(state.range(0)), state.range(1) == 1, 1000,
                 [](std::mt19937& random, Load<3> load) {
                   load.fixed = wrench_of<3>(0.5 * direction(random), 0.5 * direction(random));
                   return std::vector<Load<3>>{load};
                 });
  compare(
      state, cases.size(), 20,
      [&](std::size_t i) { benchmark::DoNotOptimize(hold(cases[i].changed, cases[i].up)); },
      [&](std::size_t i) { benchmark::DoNotOptimize(hold(cases[i].grasp, cases[i].up)); });
}

/// The certified best posture for four loads, against that for the first of them.
template <Objective objective>
void space_best_of_four_loads(benchmark::State& state) {
  const std::vector<Case> cases =
      cases_with(static_cast<std::size_t>(state.range(0)), state.range(1) == 1, 200,
                 [](std::mt19937& random, const Load<3>& load) {
                   std::vector<Load<3>> loads(4, load);
                   for (std::size_t k = 1; k < loads.size(); ++k) {
                     loads[k].weight *= std::uniform_real_distribution<>(0.5, 1)(random);
                     loads[k].com += 0.1 * direction(random);
                   }
                   return loads;
                 });
  const SpatialSettings settings{.objective = objective, .starts = 0};
  compare(
      state, cases.size(), 1,
      [&](std::size_t i) { benchmark::DoNotOptimize(best_posture(cases[i].changed, settings)); },
      [&](std::size_t i) { benchmark::DoNotOptimize(best_posture(cases[i].grasp, settings)); });
}

/// Which accelerations are withstood with drives that give three times what the weight needs,
/// against the hold of least effort or grip within the same limits. `holds`: how many it counts.
template <Objective objective>
void space_shake(benchmark::State& state) {
  const auto contacts = static_cast<std::size_t>(state.range(0));
  std::vector<Case> cases =
      cases_with(contacts, state.range(1) == 1, 200,
                 [](std::mt19937&, const Load<3>& load) { return std::vector<Load<3>>{load}; });
  std::vector<double> holds;
  for (Case& each : cases) {
    const double grip = least_grip(each.grasp, each.up).grip;
    Mechanism<3> mechanism;
    for (const std::string& finger : each.grasp.fingers())
      mechanism.fingers.push_back({.name = finger, .max_force = 3 * grip});
    each.changed = {each.grasp.loads(), each.grasp.contacts(), 1, mechanism};
    holds.push_back(shake<3>(each.changed, each.up).holds);
  }
  const HoldSettings least{.objective = objective};
  compare(
      state, cases.size(), 1,
      [&](std::size_t i) { benchmark::DoNotOptimize(shake<3>(cases[i].changed, cases[i].up)); },
      [&](std::size_t i) { benchmark::DoNotOptimize(hold(cases[i].changed, cases[i].up, least)); });
  state.counters["holds"] = median(holds);
  state.counters["holds_p95"] = quantile(holds, 0.95);
}

/// A second of swinging, the frame's origin and about two axes.
std::vector<MotionState> swing(std::size_t rows) {
  Trajectory trajectory;
  for (std::size_t k = 0; k < rows; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(rows - 1);
    trajectory.times.push_back(t);
    trajectory.positions.emplace_back(0.1 * std::sin(5 * t), 0.2 * std::cos(4 * t),
                                      0.1 * std::sin(7 * t));
    trajectory.orientations.emplace_back(
        Eigen::AngleAxisd(0.8 * std::sin(6 * t), Vector<3>(1, 2, 3).normalized()) *
        Eigen::AngleAxisd(2 * t, Vector<3>(-1, 1, 0).normalized()));
  }
  return motion_through(trajectory);
}

/// Fingers round a cylinder of 0.3 kg, 80 mm across.
Hand<3> round_hand(std::size_t fingers) {
  std::vector<Contact<3>> contacts(fingers);
  for (std::size_t k = 0; k < fingers; ++k) {
    const double at = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(fingers);
    contacts[k].normal = Vector<3>(-std::cos(at), -std::sin(at), 0);
    contacts[k].position = -0.04 * contacts[k].normal + Vector<3>(0, 0, 0.005);
    contacts[k].friction = 0.7;
    contacts[k].torsion = 0.008;
  }
  return {contacts, Vector<3>::Zero()};
}

/// What the fingers need at each of 100,000 rows of a motion, against as many holds of the same
/// loads, each found from the one before where the least effort is asked for.
template <Objective objective>
void motion_of_100000_rows(benchmark::State& state) {
  const Hand<3> hand = round_hand(static_cast<std::size_t>(state.range(0)));
  const Body body{0.3, Vector<3>::Zero(), Vector<3>(3e-4, 3e-4, 2e-4).asDiagonal()};
  const std::vector<MotionState> states = swing(100'000);
  std::vector<Wrench<3>> loads;
  for (const MotionState& each : states) loads.push_back(motion_load(body, each).at());
  const double weight = body.mass * standard_gravity;
  const MotionSettings settings{.objective = objective};
  compare(
      state, 1, 1,
      [&](std::size_t) { benchmark::DoNotOptimize(motion(hand, body, states, settings)); },
      [&](std::size_t) {
        Twist<3> y = Twist<3>::Zero();
        for (const Wrench<3>& load : loads) {
          if constexpr (objective == Objective::grip)
            y = least_grip<3>(hand, load, weight).dual;
          else
            y = hold<3>(hand, load, weight, y).dual;
          benchmark::DoNotOptimize(y.data());
        }
      });
}

void grasps(benchmark::internal::Benchmark* row) {
  row->UseManualTime()->ArgNames({"contacts", "soft"});
}
BENCHMARK(space_hold_with_wrench)
    ->Apply(grasps)
    ->Iterations(1000)
    ->ArgsProduct({{3, 4, 8, 64}, {0, 1}});
BENCHMARK(space_best_of_four_loads<Objective::effort>)
    ->Apply(grasps)
    ->Iterations(200)
    ->ArgsProduct({{4, 8}, {0, 1}});
BENCHMARK(space_best_of_four_loads<Objective::grip>)
    ->Apply(grasps)
    ->Iterations(200)
    ->ArgsProduct({{4, 8}, {0, 1}});
BENCHMARK(space_shake<Objective::effort>)
    ->Apply(grasps)
    ->Iterations(200)
    ->ArgsProduct({{3, 4, 8}, {0, 1}});
BENCHMARK(space_shake<Objective::grip>)
    ->Apply(grasps)
    ->Iterations(200)
    ->ArgsProduct({{3, 4, 8}, {0, 1}});
BENCHMARK(motion_of_100000_rows<Objective::effort>)
    ->UseManualTime()
    ->ArgName("contacts")
    ->Iterations(11)
    ->Arg(2)
    ->Arg(4);
BENCHMARK(motion_of_100000_rows<Objective::grip>)
    ->UseManualTime()
    ->ArgName("contacts")
    ->Iterations(3)
    ->Arg(2)
    ->Arg(4);

}  // namespace
