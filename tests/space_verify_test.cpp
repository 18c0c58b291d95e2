// Random grasps in space, their results as documents, and every document verified.
#include <gtest/gtest.h>

#include "files/grasp_writer.hpp"
#include "poise/grip.hpp"
#include "random_space_grasps.hpp"
#include "verify/verify.hpp"

namespace poise::test::space {
namespace {

/// Two to twelve contacts of mixed kinds, or fingers whose friction is only just enough; now and
/// then a second load, or a tilt.
SpatialFile random_file(bool least_forces) {
  const Held held = one_in(4) ? *nearly_unholdable()
                              : *grasps({.least_contacts = 2,
                                         .most_contacts = 12,
                                         .limits = one_in(2),
                                         .awkward = one_in(2)});
  SpatialFile file;
  file.contacts = held.contacts;
  if (!least_forces)
    for (Contact<3>& contact : file.contacts) contact.min_normal = 0;
  file.loads = {held.object};
  if (one_in(4)) {
    Load<3> other = held.object;
    other.weight *= real(0.3, 1);
    other.com += 0.2 * random_direction();
    file.loads.push_back(other);
  }
  if (one_in(4)) file.tilt = Tilt{random_direction(), real(0, pi / 2)};
  return file;
}

/// Confirmed as values and as a document alike.
void expect_confirmed(const SpatialFile& file, const auto& answer) {
  const Grasp<3> grasp = file.grasp();
  const std::string told = document(grasp, answer);
  RC_LOG() << told << document(file, grasp, CheckAnswer<3>{});
  RC_ASSERT(verify::refutations_text(verify::verify(grasp, answer)) == "");
  const Document text = parse_json(told, "result.json", max_result);
  RC_ASSERT(verify::refutations_text(verify::verify(file, text)) == "");
}

RC_GTEST_PROP(SpaceVerified, HoldsOfAnyGraspAre, ()) {
  const SpatialFile file = *rc::gen::exec([] { return random_file(true); });
  const Vector<3> up = *rc::gen::exec(random_direction);
  expect_confirmed(file, HoldAnswer<3>{.option = {.up = {up.x(), up.y(), up.z()}},
                                       .posture = posture_at(file.grasp(), up)});
}

RC_GTEST_PROP(SpaceVerified, BestsOfAnyGraspAre, ()) {
  if (!one_in(3)) return;
  const SpatialFile file = *rc::gen::exec([] { return random_file(one_in(2)); });
  SpatialSettings settings;
  settings.max_holds = 200;
  settings.starts = one_in(10) ? 8 : 0;
  settings.tilt = file.tilt;
  const Eigen::Quaterniond lying(Eigen::AngleAxisd(1.2, Vector<3>(0.6, 0.64, 0.48)));
  BestAnswer<3> answer{settings, best_posture(file.grasp(), settings)};
  answer.orientation = lying;
  expect_confirmed(file, answer);
}

/// Some contacts are pads, and fingers are driven each by itself or together, now and then weakly.
SpatialFile random_driven_file() {
  SpatialFile file = random_file(false);
  if (file.contacts.size() > 4) file.contacts.resize(4);
  for (Contact<3>& contact : file.contacts) {
    if (one_in(2)) continue;
    contact.torsion = 0;
    contact.share = 1;
    const Vector<2> size(real(0.05, 0.5), real(0.05, 0.5));
    contact.pad = rectangular_pad(size, tangents(contact.normal.normalized()).col(0),
                                  contact.normal.normalized(), pick(1, 3));
    if (one_in(4)) contact.pad->reach.setZero();
  }
  if (one_in(2)) file.mechanism.kind = DriveKind::coupled;
  if (!one_in(3)) return file;
  const double most = file.loads.front().weight * real(0.3, 5);
  const auto fingers = Grasp<3>(file.loads, file.contacts).fingers();
  for (const std::string& name : fingers)
    file.mechanism.fingers.push_back({.name = name, .max_force = most});
  return file;
}

RC_GTEST_PROP(SpaceVerified, HoldsByPadsAndDrivesAre, ()) {
  const SpatialFile file = *rc::gen::exec(random_driven_file);
  if (!has_grip<3>(file.grasp())) return;
  const Vector<3> up = *rc::gen::exec(random_direction);
  const Objective objective = one_in(2) ? Objective::grip : Objective::effort;
  HoldAnswer<3> answer{.option = {.up = {up.x(), up.y(), up.z()}}};
  answer.settings.objective = objective;
  answer.posture = posture_at(file.grasp(), up, answer.settings);
  const Hold<3>& hold = answer.posture.hold();
  if (!hold.holdable && !hold.proven) return;
  expect_confirmed(file, answer);
}

RC_GTEST_PROP(SpaceVerified, BestsByPadsAndDrivesAre, ()) {
  if (!one_in(10)) return;
  const SpatialFile file = *rc::gen::exec(random_driven_file);
  if (!has_grip<3>(file.grasp())) return;
  SpatialSettings settings;
  settings.objective = one_in(2) ? Objective::grip : Objective::effort;
  settings.max_holds = 60;
  settings.starts = 0;
  settings.tilt = file.tilt;
  expect_confirmed(file, BestAnswer<3>{settings, best_posture(file.grasp(), settings)});
}

/// Jaws, or a few contacts, with the com next to their line or to one of them: there y grows as
/// long as rounding allows, and what the search takes for proven may not be.
SpatialFile nearly_degenerate() {
  const double offset = std::pow(10, real(-17, -5));
  SpatialFile file;
  if (one_in(2)) {
    file.contacts = {{.position = {-1, 0, 0}, .normal = {1, 0, 0}, .friction = real(0.1, 1)},
                     {.position = {1, 0, 0}, .normal = {-1, 0, 0}, .friction = real(0.1, 1)}};
    if (one_in(2)) file.contacts[0].torsion = 0.1 * file.contacts[0].friction;
    file.loads = {{.weight = 1, .com = Vector<3>(real(-0.9, 0.9), offset, 0)}};
  } else {
    const Held held = *grasps({.least_contacts = 2, .most_contacts = 5, .limits = false});
    file.contacts = held.contacts;
    for (Contact<3>& contact : file.contacts) contact.torsion = 0;  // too much for a small grasp
    file.loads = {{.weight = 1, .com = file.contacts[0].position + offset * random_direction()}};
  }
  if (one_in(3)) file.tilt = Tilt{random_direction(), real(0, pi / 2)};
  return file;
}

/// What is called proven is. Where rounding of y leaves a gap, its size may be in doubt, too.
RC_GTEST_PROP(SpaceVerified, OptimaOfNearlyDegenerateGraspsAre, ()) {
  if (!one_in(5)) return;
  const SpatialFile file = *rc::gen::exec(nearly_degenerate);
  SpatialSettings settings;
  settings.max_holds = 200;
  settings.starts = 0;
  settings.tilt = file.tilt;
  const BestAnswer<3> answer{settings, best_posture(file.grasp(), settings)};
  if (answer.best.status == Status::gap) return;
  const std::string refuted = verify::refutations_text(verify::verify(file.grasp(), answer));
  if (refuted.find("cuts") != std::string::npos) RC_FAIL(grasp_document(file) + refuted);
}

}  // namespace
}  // namespace poise::test::space
