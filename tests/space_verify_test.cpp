// Random grasps in space, their results as documents, and every document verified.
#include <gtest/gtest.h>

#include <iostream>
#include <sstream>

#include "files/result.hpp"
#include "files/spatial.hpp"
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
  file.scenarios = {held.object};
  if (one_in(4)) {
    Object<3> other = held.object;
    other.weight *= real(0.3, 1);
    other.com += 0.2 * random_direction();
    file.scenarios.push_back(other);
  }
  if (one_in(4)) file.tilt = Tilt{random_direction(), real(0, pi / 2)};
  return file;
}

/// What the verifier refutes.
std::string refuted(const SpatialFile& file, const std::string& document) {
  std::ostringstream words;
  const verify::Claims claims =
      verify::verify(file, parse_json(document, "result.json", max_result));
  for (const verify::Refutation& each : claims.refutations())
    words << each.path << ": " << each.words << ": " << each.off << " of " << each.allowed << '\n';
  return words.str();
}

RC_GTEST_PROP(SpaceVerified, HoldsOfAnyGraspAre, ()) {
  const SpatialFile file = *rc::gen::exec([] { return random_file(true); });
  const std::vector<Grasp<3>> grasps = file.grasps();
  const Vector<3> up = *rc::gen::exec(random_direction);
  RC_ASSERT(refuted(file, hold_document(grasps, hold_all(grasps, up), {})) == "");
}

RC_GTEST_PROP(SpaceVerified, BestsOfAnyGraspAre, ()) {
  if (!one_in(3)) return;
  const SpatialFile file = *rc::gen::exec([] { return random_file(one_in(2)); });
  const std::vector<Grasp<3>> grasps = file.grasps();
  SpatialSettings settings;
  settings.max_holds = 200;
  settings.starts = one_in(10) ? 8 : 0;
  settings.tilt = file.tilt;
  const Eigen::Quaterniond lying(Eigen::AngleAxisd(1.2, Vector<3>(0.6, 0.64, 0.48)));
  RC_ASSERT(refuted(file, best_document(grasps, best_posture(grasps, settings), settings, lying)) ==
            "");
}

}  // namespace
}  // namespace poise::test::space
