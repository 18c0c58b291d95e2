// Random grasps in space, their results as documents, and every document verified.
#include <gtest/gtest.h>

#include "random_space_grasps.hpp"
#include "verify/verify.hpp"

namespace poise::test::space {
namespace {

/// Two to twelve contacts of mixed kinds, or fingers whose friction is only just enough; now and
/// then a second scenario, or a tilt.
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
  RC_ASSERT(verify::refutations_text(verify::verify(grasp, answer)) == "");
  const Document text = parse_json(document(grasp, answer), "result.json", max_result);
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

}  // namespace
}  // namespace poise::test::space
