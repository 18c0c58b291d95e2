// The posture of least grip in space: brute force, its law of the greatest weight, and its document
// checked and forged.
#include <gtest/gtest.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "ask/ask.hpp"
#include "ask/document.hpp"
#include "ask/document_reader.hpp"
#include "poise/grip.hpp"
#include "random_space_grasps.hpp"
#include "verify/verify.hpp"

namespace poise::test::space {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Best<3> best_for_grip(const Grasp<3>& grasp) {
  return best_posture(grasp, {.objective = Objective::grip, .max_holds = 400, .starts = 0});
}

double grip_at(const Grasp<3>& grasp, const Vector<3>& up) {
  const Hold<3> held = least_grip(grasp, up);
  return held.holdable ? held.grip : infinity;
}

/// Points spread over the sphere.
std::vector<Vector<3>> sphere(int count) {
  std::vector<Vector<3>> points;
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2 * k + 1.0) / count, r = std::sqrt(1 - z * z);
    const double turn = k * pi * (3 - std::sqrt(5.0));
    points.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
  }
  return points;
}

const Recipe plain{.least_contacts = 3, .most_contacts = 5, .limits = false, .awkward = false};

RC_GTEST_PROP(BestForGrip, NoPostureNeedsLess, ()) {
  if (!one_in(10)) return;
  const Grasp<3> grasp = (*space::grasps(plain)).grasp();
  const Best<3> best = best_for_grip(grasp);
  double least = infinity;
  for (const Vector<3>& up : sphere(300)) least = std::min(least, grip_at(grasp, up));
  if (best.status == Status::unholdable) {
    RC_ASSERT(least == infinity);
    return;
  }
  RC_ASSERT(best.lower_bound <= least * (1 + 1e-7));
  if (!best.holdable()) return;
  RC_ASSERT(std::abs(grip_at(grasp, best.best().up) - best.best().value()) <=
            1e-7 * (grasp.size() + least));
  if (best.status == Status::optimal)
    RC_ASSERT(best.best().value() <= least * (1 + 2e-6) + 1e-9 * grasp.size());
}

// Drives that are limited to c hold c / F* newtons for each newton of F*'s load: the posture of
// least grip is the one in which the gripper carries most.
RC_GTEST_PROP(BestForGrip, TheGreatestWeightIsTheLimitOverTheGrip, ()) {
  if (!one_in(5)) return;
  const Held held = *space::grasps(plain);
  const Vector<3> up = random_direction();
  const double F = grip_at(held.grasp(), up), W = held.object.weight;
  if (!(F < infinity) || !(F > 1e-3 * W)) return;
  const auto holds = [&](double weight) {
    Mechanism<3> limited;
    for (std::size_t k = 0; k < held.contacts.size(); ++k)
      limited.fingers.push_back({.name = std::to_string(k), .max_force = 1});
    const Grasp<3> grasp({.weight = weight, .com = held.object.com}, held.contacts, 1, limited);
    const bool by_effort = hold<3>(grasp, up).holdable;
    RC_ASSERT(by_effort == hold<3>(grasp, up, {.objective = Objective::grip}).holdable);
    return by_effort;
  };
  RC_ASSERT(holds(W / F * 0.999));
  RC_ASSERT(!holds(W / F * 1.001));
}

SpatialFile file_of(const Held& held) {
  SpatialFile file;
  file.loads = {held.object};
  file.contacts = held.contacts;
  file.objective = Objective::grip;
  return file;
}

nlohmann::ordered_json answered(const SpatialFile& file, const Grasp<3>& grasp, Command command) {
  const AnswerTo<3> answer = ask(file, grasp, {.command = command, .max_holds = 400});
  return nlohmann::ordered_json::parse(document<3>(file, grasp, answer));
}

bool is_confirmed(const SpatialFile& file, const nlohmann::ordered_json& result) {
  const verify::Verdict verdict =
      verify::verify(GraspFile(file), parse_json(result.dump(), "result.json"));
  if (std::getenv("SHOW") && !verdict.confirmed()) std::cerr << refutations_text(verdict);
  return verdict.confirmed();
}

RC_GTEST_PROP(BestForGrip, ItsDocumentIsConfirmedAndForgedOnesAreNot, ()) {
  if (!one_in(20)) return;
  SpatialFile file = file_of(*space::grasps(plain));
  if (one_in(2)) file.mechanism.kind = DriveKind::coupled;
  const Grasp<3> grasp = file.grasp();
  const auto best = answered(file, grasp, Command::best);
  RC_ASSERT(is_confirmed(file, best));
  if (best["best"].is_null() || best["best"]["grip"] < 1e-3 * file.loads[0].weight) return;
  auto forged = best;
  forged["lower_bound"] = 1.001 * best["lower_bound"].get<double>();
  RC_ASSERT(!is_confirmed(file, forged));
  forged = best;
  forged["best"]["grip"] = 0.999 * best["best"]["grip"].get<double>();
  RC_ASSERT(!is_confirmed(file, forged));
  // Rates left out would make cuts deeper.
  forged = best;
  for (auto& cut : forged["cuts"])
    if (cut.contains("rates"))
      for (auto& rate : cut["rates"]) rate = 0.5 * rate.get<double>();
  RC_ASSERT(!is_confirmed(file, forged));
}

RC_GTEST_PROP(LeastGripOfAHold, ItsDocumentIsConfirmedAndForgedOnesAreNot, ()) {
  if (!one_in(5)) return;
  const SpatialFile file =
      file_of(*space::grasps({.least_contacts = 2, .most_contacts = 5, .awkward = false}));
  const Grasp<3> grasp = file.grasp();
  const auto hold = answered(file, grasp, Command::hold);
  RC_ASSERT(is_confirmed(file, hold));
  if (!hold["holdable"].get<bool>() || hold["lower_bound"] < 1e-3 * file.loads[0].weight) return;
  for (const char* const key : {"grip", "lower_bound"}) {
    auto forged = hold;
    forged[key] = 1.001 * hold[key].get<double>();
    RC_ASSERT(!is_confirmed(file, forged));
  }
  // A claim that is higher altogether, with the forces scaled and the rates as they are.
  auto forged = hold;
  forged["rates"][0] = hold["rates"][0].get<double>() + 0.01;
  RC_ASSERT(!is_confirmed(file, forged));
  forged = hold;
  forged["drives"][0]["effort"] = hold["drives"][0]["effort"].get<double>() + 0.01;
  RC_ASSERT(!is_confirmed(file, forged));
}

}  // namespace
}  // namespace poise::test::space
