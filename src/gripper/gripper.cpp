#include "gripper/gripper.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "shape/number_text.hpp"

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

bool from_behind(const Meeting& meeting, const Vector<3>& direction) {
  return direction.dot(meeting.outward) > 0;
}

Touch touch(const Surface& surface, const Vector<3>& origin, const Vector<3>& direction,
            double farthest, const std::string& finger) {
  const Eigen::AlignedBox3d& box = surface.bounds();
  // From farther away too few digits are left.
  if (!((origin - box.center()).norm() <= 1e6 * box.diagonal().norm()))
    throw MissedGrip(finger + " is farther than a million times its size from the object");
  const std::optional<Meeting> meeting = surface.first(origin, direction);
  if (!meeting) return {};
  if (surface.closed() && from_behind(*meeting, direction) && box.contains(origin))
    return {{}, true};
  if (meeting->distance > farthest) return {};
  return {meeting};
}

Contact<3> contact_at(const Meeting& meeting, const Vector<3>& direction) {
  Contact<3> contact;
  contact.position = meeting.point;
  // The finger comes from outside, whatever a mesh that is not closed believes.
  contact.normal = from_behind(meeting, direction) ? meeting.outward : Vector<3>(-meeting.outward);
  return contact;
}

/// Contacts, and which of them meet the surface from behind.
struct Grip {
  std::vector<Contact<3>> contacts{};
  std::vector<bool> behind{};

  void add(const Contact<3>& contact, const Meeting& meeting, const Vector<3>& direction) {
    contacts.push_back(contact);
    behind.push_back(from_behind(meeting, direction));
  }
};

struct Pad {
  std::string name;
  double side;  ///< of the middle, along x
  Grip grip{};
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
      const Touch at = touch(surface, jaw.pose.position + jaw.pose.orientation * start, direction,
                             jaw.opening, "the " + pad.name + " pad");
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
    pad.grip.add(contact, meeting, direction);
  }
}

Grip grip_of(const ParallelJaw& jaw, const Surface& surface) {
  Pad left{"left", -1}, right{"right", 1};
  close(left, jaw, surface);
  close(right, jaw, surface);
  if (left.inside && right.inside)
    throw MissedGrip("both pads begin inside the object: open wider, or move the gripper");
  for (const Pad& pad : {left, right})
    if (pad.inside)
      throw MissedGrip("the " + pad.name +
                       " pad begins inside the object: open wider, or move the gripper");
  if (left.grip.contacts.empty() && right.grip.contacts.empty())
    throw MissedGrip("the pads meet nothing: the object is not between them");
  for (const Pad& pad : {left, right})
    if (pad.grip.contacts.empty())
      throw MissedGrip("the " + pad.name + " pad meets nothing, the other one does");
  Grip both = left.grip;
  both.contacts.insert(both.contacts.end(), right.grip.contacts.begin(), right.grip.contacts.end());
  both.behind.insert(both.behind.end(), right.grip.behind.begin(), right.grip.behind.end());
  return both;
}

Grip grip_of(const Fingertips& hand, const Surface& surface) {
  Grip grip;
  for (std::size_t i = 0; i < hand.rays.size(); ++i) {
    const Fingertip& finger = hand.rays[i];
    const std::string name =
        "finger " + (finger.finger.empty() ? std::to_string(i) : finger.finger);
    const Vector<3> direction = hand.pose.orientation * finger.direction;
    const Touch at = touch(surface, hand.pose.position + hand.pose.orientation * finger.origin,
                           direction, std::numeric_limits<double>::infinity(), name);
    if (at.inside) throw MissedGrip(name + " begins inside the object: begin farther out");
    if (!at.meeting) throw MissedGrip(name + " meets nothing: its ray passes the object");
    Contact<3> contact = contact_at(*at.meeting, direction);
    contact.friction = hand.friction;
    contact.torsion = hand.torsion;
    contact.max_normal = hand.max_force;
    contact.finger = finger.finger;
    grip.add(contact, *at.meeting, direction);
  }
  return grip;
}

/// "contacts 0 to 15 and 20"
std::string numbers_of(const std::vector<bool>& chosen) {
  std::vector<std::string> parts;
  std::size_t count = 0;
  for (std::size_t first = 0; first < chosen.size(); ++first) {
    if (!chosen[first]) continue;
    std::size_t last = first;
    while (last + 1 < chosen.size() && chosen[last + 1]) ++last;
    count += last + 1 - first;
    parts.push_back(std::to_string(first) + (last > first ? " to " + std::to_string(last) : ""));
    first = last;
  }
  std::string text = count == 1 ? "contact " : "contacts ";
  for (std::size_t k = 0; k < parts.size(); ++k)
    text += (k == 0 ? "" : k + 1 < parts.size() ? ", " : " and ") + parts[k];
  return text;
}

/// A wrong unit or frame shows itself.
std::string where(const Surface& surface) {
  const auto listed = [](const Vector<3>& v, const std::string& between) {
    return number_text(v.x(), 3) + between + number_text(v.y(), 3) + between +
           number_text(v.z(), 3);
  };
  const Eigen::AlignedBox3d& box = surface.bounds();
  return "; the object is " + listed(box.sizes(), " x ") + " m large, its middle at (" +
         listed(box.center(), ", ") + ") m";
}

}  // namespace

std::vector<Contact<3>> contacts(const Gripper& gripper, const Surface& surface,
                                 std::vector<std::string>* notes) {
  try {
    Grip grip = std::visit([&](const auto& each) { return grip_of(each, surface); }, gripper);
    if (notes && std::find(grip.behind.begin(), grip.behind.end(), true) != grip.behind.end())
      notes->push_back(numbers_of(grip.behind) +
                       " meet the surface from behind: it is open there, or faces the wrong way");
    return std::move(grip.contacts);
  } catch (const MissedGrip& missed) {
    throw MissedGrip(missed.what() + where(surface));
  }
}

}  // namespace poise
