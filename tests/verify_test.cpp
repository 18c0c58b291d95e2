// The verifier confirms what is right and refutes what is not.
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "files/result.hpp"
#include "random_grasps.hpp"
#include "verify/verify.hpp"

namespace poise {
namespace {

using Json = nlohmann::ordered_json;
using test::Held;

GraspFile file_of(const Held& held) {
  GraspFile file;
  file.object = held.object;
  file.contacts = held.contacts;
  return file;
}

verify::Claims checked(const GraspFile& file, const std::string& text) {
  return verify::verify(file, parse_json(text, "result.json", max_result));
}

std::string words(const verify::Claims& claims) {
  std::ostringstream text;
  for (const verify::Refutation& each : claims.refutations())
    text << each.path << ": " << each.words << ": " << each.off << " of " << each.allowed << "\n";
  return text.str();
}

std::string hold_text(const GraspFile& file, double theta, double cap = 1e6) {
  const Grasp<2> grasp = file.grasp();
  return hold_document(grasp, theta, hold(grasp, up_at(theta), {cap}), {cap});
}
std::string best_text(const GraspFile& file, const CurveSettings& settings = {}) {
  const Grasp<2> grasp = file.grasp();
  return best_document(grasp, best_posture(grasp, settings), settings);
}
std::string curve_text(const GraspFile& file, const CurveSettings& settings = {}) {
  const Grasp<2> grasp = file.grasp();
  return curve_document(grasp, posture_curve(grasp, settings), settings);
}

void expect_confirmed(const GraspFile& file, const std::string& text) {
  const verify::Claims claims = checked(file, text);
  RC_ASSERT(words(claims) == "");
}

RC_GTEST_PROP(Verify, ConfirmsHolds, ()) {
  const Held held = *test::grasps();
  expect_confirmed(file_of(held), hold_text(file_of(held), *rc::gen::exec(test::random_angle)));
}

RC_GTEST_PROP(Verify, ConfirmsCurves, ()) {
  const Held held = *test::grasps({.most_contacts = 5});
  const CurveSettings settings{*rc::gen::element(Domain::all, Domain::pinched)};
  expect_confirmed(file_of(held), curve_text(file_of(held), settings));
}

RC_GTEST_PROP(Verify, ConfirmsTheBest, ()) {
  const Held held = *test::grasps({.most_contacts = 5});
  const CurveSettings settings{*rc::gen::element(Domain::all, Domain::pinched)};
  expect_confirmed(file_of(held), best_text(file_of(held), settings));
}

RC_GTEST_PROP(Verify, ConfirmsTheNearlyUnholdable, ()) {
  const Held held = *test::nearly_unholdable();
  expect_confirmed(file_of(held), best_text(file_of(held)));
  expect_confirmed(file_of(held), curve_text(file_of(held)));
}

}  // namespace
}  // namespace poise
