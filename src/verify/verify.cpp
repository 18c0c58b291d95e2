#include "verify/verify.hpp"

#include <algorithm>

#include "verify/capacity.hpp"
#include "verify/plane.hpp"
#include "verify/space.hpp"

namespace poise::verify {
namespace {

/// A key that is given twice means different things to different readers.
void refuse_twins(const Document& document, const Value& value) {
  if (const auto* parts = std::get_if<List>(&value.data))
    for (const Value& part : *parts) refuse_twins(document, part);
  if (const auto* members = std::get_if<Mapping>(&value.data))
    for (auto member = members->begin(); member != members->end(); ++member) {
      const auto same = [&](const Member& other) { return other.key == member->key; };
      if (std::any_of(members->begin(), member, same))
        document.fail(member->at, "\"" + member->key + "\" is given twice");
      refuse_twins(document, member->value);
    }
}

/// What the grasp file says, said again.
void check_reading(Claims& claims, const Held& held, const Field& root) {
  const auto check_load = [&](const Field& field, const Load& load) {
    const Field weight = field.get("weight", "a force [N]"), com = field.get("com", "a point");
    claims.check(weight, "weight is that of the grasp", difference(weight.finite(), load.weight),
                 0);
    claims.check(com, "com is that of the grasp", (read_vector(com, held.dim) - load.com).norm(),
                 0);
  };
  if (held.dim == 2) {
    check_load(root, held.loads.front());
  } else {
    const Field scenarios = root.get("scenarios", "a list of loads");
    const auto loads = scenarios.list();
    if (loads.size() != held.loads.size())
      scenarios.fail("must have " + std::to_string(held.loads.size()) + ", as the grasp has");
    for (std::size_t k = 0; k < loads.size(); ++k) check_load(loads[k], held.loads[k]);
  }
  const Field list = root.get("contacts", "a list of contacts");
  const auto contacts = list.list();
  if (contacts.size() != held.contacts.size())
    list.fail("must have " + std::to_string(held.contacts.size()) + " contacts, as the grasp has");
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Touch& contact = held.contacts[i];
    const auto vector = [&](const char* key, const Vec& expected) {
      const Field field = contacts[i].get(key, "a vector");
      claims.check(field, std::string(key) + " is that of the grasp",
                   (read_vector(field, held.dim) - expected).norm(), 0);
    };
    const auto number = [&](const char* key, Real expected) {
      const Field field = contacts[i].get(key, "a number");
      const bool none = field.is_null() && !std::isfinite(expected);
      claims.check(field, std::string(key) + " is that of the grasp",
                   none ? 0 : difference(field.finite(), expected), 0);
    };
    vector("position", contact.position);
    vector("normal", contact.normal);
    number("friction", contact.friction);
    number("min_normal", contact.lo);
    number("max_normal", contact.hi);
    number("share", contact.share);
    if (held.dim == 3) number("torsion", contact.torsion);
  }
  claims.note("force_closure, cradled_deg and warnings are not checked.");
}

Held held_by(const PlanarFile& file) { return held(file.grasp()); }
Held held_by(const SpatialFile& file) { return held(file.grasps()); }

}  // namespace

Claims verify(const GraspFile& file, const Document& result) {
  refuse_twins(result, result.root);
  const Field root(result);
  const Field version = root.get("poise_result", "1, the version of results");
  if (version.finite() != 1) version.fail("must be 1, the version that this program knows");
  const Field command = root.get("command", "check, hold, best, curve or capacity");
  const std::string& name = command.word({"check", "hold", "best", "curve", "capacity"});
  const Field options = root.get("options", "a mapping");
  Claims claims;
  const Held grasp = std::visit([](const auto& each) { return held_by(each); }, file);
  if (name == "check") {
    check_reading(claims, grasp, root);
  } else if (name == "hold") {
    check_hold(claims, grasp, root, options.get("force_cap", "a number of weights").finite());
  } else if (name == "capacity") {
    check_capacity(claims, grasp, root);
  } else if (name == "curve") {
    if (grasp.dim == 3) command.fail("is curve, which is for the plane: the grasp is in space");
    check_curve(claims, grasp, root);
  } else if (grasp.dim == 2) {
    check_best_in_plane(claims, grasp, root);
  } else {
    check_best_in_space(claims, grasp, root);
  }
  return claims;
}

}  // namespace poise::verify
