#include "files/gripper_field.hpp"

#include <cmath>

#include "shape/number_text.hpp"

namespace poise {
namespace {

Eigen::Quaterniond read_quaternion(const Field& field) {
  const std::vector<Field> parts = field.list();
  if (parts.size() != 4)
    field.fail("is a list of " + std::to_string(parts.size()) + ", must be [w, x, y, z]");
  const Eigen::Vector4d wxyz(parts[0].number(), parts[1].number(), parts[2].number(),
                             parts[3].number());
  if (!(wxyz.stableNorm() > 0)) field.fail("has no length, must be a rotation [w, x, y, z]");
  const Eigen::Vector4d unit = wxyz.stableNormalized();
  return {unit[0], unit[1], unit[2], unit[3]};
}

/// What a gripper has that its type does not change.
template <class Gripper>
void read_common(const Field& field, double unit, Gripper& gripper) {
  if (const auto quaternion = field.find("quaternion"))
    gripper.pose.orientation = read_quaternion(*quaternion);
  gripper.friction = field.get("friction", "a number").at_least_zero();
}

template <class Gripper>
void read_torsion(const Field& field, double unit, Gripper& gripper) {
  const auto torsion = field.find("torsion");
  if (!torsion) return;
  gripper.torsion = unit * torsion->at_least_zero();
  if (gripper.torsion > 0 && gripper.friction == 0)
    torsion->fail("is given without friction, must be left out, or give friction above 0");
}

int read_samples(const Field& field) {
  const double samples = field.number();
  if (!(samples >= 1 && samples <= 10000) || samples != std::floor(samples))
    field.fail("is " + number_text(samples) + ", must be a whole number from 1 to 10000");
  return static_cast<int>(samples);
}

ParallelJaw read_jaw(const Field& field, double unit) {
  field.mapping({"type", "position", "quaternion", "opening", "pad", "friction", "contact",
                 "torsion", "samples", "max_force"});
  ParallelJaw jaw;
  const auto contact = field.find("contact");
  if (contact && contact->word({"pads", "facets"}) == "facets") jaw.contact = JawContact::facets;
  if (const auto torsion = field.find("torsion"); torsion && jaw.contact == JawContact::pads)
    torsion->fail("is given for pads, must be left out: their points resist the twist");
  read_common(field, unit, jaw);
  read_torsion(field, unit, jaw);
  if (const auto force = field.find("max_force")) jaw.max_force = force->above_zero();
  jaw.pose.position = unit * field.get("position", coordinates<3>).vector<3>();
  jaw.opening = unit * field.get("opening", "the distance of the open pads").above_zero();
  const Field pad = field.get("pad", "a mapping (keys: width, height, depth)");
  pad.mapping({"width", "height", "depth"});
  jaw.width = unit * pad.get("width", "a length").above_zero();
  jaw.height = unit * pad.get("height", "a length").above_zero();
  if (const auto depth = pad.find("depth")) jaw.depth = unit * depth->at_least_zero();
  if (const auto samples = field.find("samples")) jaw.samples = read_samples(*samples);
  return jaw;
}

Fingertip read_fingertip(const Field& field, double unit) {
  field.mapping({"origin", "direction", "finger"});
  Fingertip tip;
  tip.origin = unit * field.get("origin", coordinates<3>).vector<3>();
  const Field direction = field.get("direction", coordinates<3>);
  tip.direction = direction.vector<3>();
  if (!(tip.direction.stableNorm() > 0)) direction.fail("has no length, must be a direction");
  tip.direction = tip.direction.stableNormalized();
  if (const auto finger = field.find("finger")) tip.finger = finger->text();
  return tip;
}

Fingertips read_fingertips(const Field& field, double unit) {
  field.mapping({"type", "position", "quaternion", "rays", "friction", "torsion", "max_force"});
  Fingertips hand;
  read_common(field, unit, hand);
  read_torsion(field, unit, hand);
  if (const auto force = field.find("max_force")) hand.max_force = force->at_least_zero();
  if (const auto position = field.find("position"))
    hand.pose.position = unit * position->vector<3>();
  const Field rays = field.get("rays", "a list of {origin, direction}");
  for (const Field& ray : rays.list()) hand.rays.push_back(read_fingertip(ray, unit));
  if (hand.rays.empty()) rays.fail("is empty, must hold at least one ray");
  return hand;
}

Suction read_suction(const Field& field, double unit) {
  field.mapping(
      {"type", "position", "quaternion", "direction", "cups", "diameter", "adhesion", "friction"});
  Suction suction;
  read_common(field, unit, suction);
  if (const auto position = field.find("position"))
    suction.pose.position = unit * position->vector<3>();
  if (const auto direction = field.find("direction")) {
    suction.direction = direction->vector<3>();
    if (!(suction.direction.stableNorm() > 0))
      direction->fail("has no length, must be a direction");
    suction.direction = suction.direction.stableNormalized();
  }
  const Field cups = field.get("cups", "a list of [x, y, z]");
  for (const Field& cup : cups.list()) suction.cups.emplace_back(unit * cup.vector<3>());
  if (suction.cups.empty()) cups.fail("is empty, must hold at least one cup");
  suction.diameter = unit * field.get("diameter", "that of a cup's rim").above_zero();
  suction.adhesion = field.get("adhesion", "the pull of a cup [N]").above_zero();
  return suction;
}

}  // namespace

Gripper read_gripper(const Field& field, double unit) {
  const Field type = field.get("type", "parallel_jaw, fingertips or suction");
  const std::string& name = type.word({"parallel_jaw", "fingertips", "suction"});
  if (name == "suction") return read_suction(field, unit);
  if (name == "fingertips") return read_fingertips(field, unit);
  return read_jaw(field, unit);
}

}  // namespace poise
