#include "gripper/gripper.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace poise {
namespace {

/// Rows of equal cells, as near to squares as it goes: how many of them a number makes.
int columns_of(int samples, double width, double height) {
  int best = 1;
  double least = std::numeric_limits<double>::infinity();
  for (int columns = 1; columns <= samples; ++columns) {
    if (samples % columns != 0) continue;
    const double cell = width / columns, other = height * columns / samples;
    if (const double oblong = std::abs(std::log(cell / other)); oblong < least) {
      least = oblong;
      best = columns;
    }
  }
  return best;
}

/// Where one finger's ray meets the object.
struct Touch {
  std::optional<Meeting> meeting{};
  bool inside{false};  ///< the ray begins in the object
};

Touch touch(const Surface& surface, const Vector<3>& origin, const Vector<3>& direction,
            double farthest) {
  const std::optional<Meeting> meeting = surface.first(origin, direction);
  if (!meeting) return {};
  if (surface.closed() && direction.dot(meeting->outward) > 0) return {{}, true};
  if (meeting->distance > farthest) return {};
  return {meeting};
}

Contact<3> contact_at(const Meeting& meeting, const Vector<3>& direction) {
  Contact<3> contact;
  contact.position = meeting.point;
  // The finger comes from outside, whatever a mesh that is not closed believes.
  contact.normal =
      direction.dot(meeting.outward) > 0 ? meeting.outward : Vector<3>(-meeting.outward);
  return contact;
}

struct Pad {
  std::string name;
  double side;  ///< of the middle, along x
  std::vector<Contact<3>> contacts{};
  bool inside{false};
};

void close(Pad& pad, const ParallelJaw& jaw, const Surface& surface) {
  const Vector<3> direction = jaw.pose.orientation * Vector<3>(-pad.side, 0, 0);
  const int columns = columns_of(jaw.samples, jaw.width, jaw.height), rows = jaw.samples / columns;
  std::vector<Meeting> met;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const Vector<3> start(pad.side * jaw.opening / 2,
                            jaw.width * ((column + 0.5) / columns - 0.5),
                            jaw.height * ((row + 0.5) / rows - 0.5));
      const Touch at =
          touch(surface, jaw.pose.position + jaw.pose.orientation * start, direction, jaw.opening);
      pad.inside = pad.inside || at.inside;
      if (at.meeting) met.push_back(*at.meeting);
    }
  double first = std::numeric_limits<double>::infinity();
  for (const Meeting& meeting : met) first = std::min(first, meeting.distance);
  for (const Meeting& meeting : met) {
    if (meeting.distance > first + jaw.depth) continue;
    Contact<3> contact = contact_at(meeting, direction);
    contact.friction = jaw.friction;
    contact.torsion = jaw.torsion;
    contact.max_normal = jaw.max_force / jaw.samples;
    contact.share = 1.0 / jaw.samples;
    contact.finger = pad.name;
    pad.contacts.push_back(contact);
  }
}

std::vector<Contact<3>> contacts_of(const ParallelJaw& jaw, const Surface& surface) {
  Pad left{"left", -1}, right{"right", 1};
  close(left, jaw, surface);
  close(right, jaw, surface);
  if (left.inside && right.inside)
    throw MissedGrip("both pads begin inside the object: open wider, or move the gripper");
  for (const Pad& pad : {left, right})
    if (pad.inside)
      throw MissedGrip("the " + pad.name +
                       " pad begins inside the object: open wider, or move the gripper");
  if (left.contacts.empty() && right.contacts.empty())
    throw MissedGrip("the pads meet nothing: the object is not between them");
  for (const Pad& pad : {left, right})
    if (pad.contacts.empty())
      throw MissedGrip("the " + pad.name + " pad meets nothing, the other one does");
  std::vector<Contact<3>> both = left.contacts;
  both.insert(both.end(), right.contacts.begin(), right.contacts.end());
  return both;
}

std::vector<Contact<3>> contacts_of(const Fingertips& hand, const Surface& surface) {
  std::vector<Contact<3>> result;
  for (std::size_t i = 0; i < hand.rays.size(); ++i) {
    const Fingertip& finger = hand.rays[i];
    const std::string name =
        "finger " + (finger.finger.empty() ? std::to_string(i) : finger.finger);
    const Vector<3> direction = hand.pose.orientation * finger.direction;
    const Touch at = touch(surface, hand.pose.position + hand.pose.orientation * finger.origin,
                           direction, std::numeric_limits<double>::infinity());
    if (at.inside) throw MissedGrip(name + " begins inside the object: begin farther out");
    if (!at.meeting) throw MissedGrip(name + " meets nothing: its ray passes the object");
    Contact<3> contact = contact_at(*at.meeting, direction);
    contact.friction = hand.friction;
    contact.torsion = hand.torsion;
    contact.max_normal = hand.max_force;
    contact.finger = finger.finger;
    result.push_back(contact);
  }
  return result;
}

}  // namespace

std::vector<Contact<3>> contacts(const Gripper& gripper, const Surface& surface) {
  return std::visit([&](const auto& each) { return contacts_of(each, surface); }, gripper);
}

}  // namespace poise
