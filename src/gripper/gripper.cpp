#include "gripper/gripper.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
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

  void add(Contact<3> contact, bool is_behind) {
    contacts.push_back(std::move(contact));
    behind.push_back(is_behind);
  }
};

/// One of the two pads of a jaw.
struct Side {
  std::string name;
  double x;  ///< where it stands, in half openings
  Grip grip{};
  bool inside{false};
};

Vector<3> direction_of(const ParallelJaw& jaw, double x) {
  return jaw.pose.orientation * Vector<3>(-x, 0, 0);
}

/// Where rays of a pad meet the surface: `columns` x `rows` of them, their starts in parts of the
/// pad's sides.
template <class Start>
std::vector<Meeting> meetings(Side& side, const ParallelJaw& jaw, const Surface& surface,
                              int columns, int rows, const Start& start) {
  const Vector<3> direction = direction_of(jaw, side.x);
  std::vector<Meeting> met;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const Vector<2> part = start(column, row);
      const Vector<3> from(side.x * jaw.opening / 2, jaw.width * part.x(), jaw.height * part.y());
      const Touch at = touch(surface, jaw.pose.position + jaw.pose.orientation * from, direction,
                             jaw.opening, "the " + side.name + " pad");
      side.inside = side.inside || at.inside;
      if (at.meeting) met.push_back(*at.meeting);
    }
  return met;
}

/// Where a pad touches.
struct Print {
  std::vector<Meeting> centres;  ///< of cells
  std::vector<Meeting> corners;  ///< of cells, for how far it reaches
};

Print print_of(Side& side, const ParallelJaw& jaw, const Surface& surface) {
  const int columns = columns_of(jaw.samples, jaw.width, jaw.height), rows = jaw.samples / columns;
  const auto parts = [&](double column, double row) {
    return Vector<2>(column / columns - 0.5, row / rows - 0.5);
  };
  Print print{meetings(side, jaw, surface, columns, rows,
                       [&](int i, int j) { return parts(i + 0.5, j + 0.5); }),
              {}};
  if (jaw.contact == JawContact::pads && !print.centres.empty() && !side.inside) {
    Side aside = side;  // a corner that begins inside is not the pad
    print.corners = meetings(aside, jaw, surface, columns + 1, rows + 1, parts);
  }
  double first = std::numeric_limits<double>::infinity();
  for (const Meeting& meeting : print.centres) first = std::min(first, meeting.distance);
  for (std::vector<Meeting>* met : {&print.centres, &print.corners})
    std::erase_if(*met, [&](const Meeting& each) { return each.distance > first + jaw.depth; });
  return print;
}

/// How far `points` extend along a direction: to the lesser and the greater side of the origin.
Vector<2> range(const std::vector<Vector<3>>& points, const Vector<3>& direction) {
  Vector<2> range = Vector<2>::Zero();
  for (const Vector<3>& point : points) {
    range[0] = std::min(range[0], direction.dot(point));
    range[1] = std::max(range[1], direction.dot(point));
  }
  return range;
}

/// Turns the pad so that a rectangle about the points where it touches, which are in its plane, is
/// smallest: along `side`, or along the line that lies nearest to the points. Its reach is what
/// they extend to both sides, so that the centre of pressure stays among them.
void settle(Pad& pad, const std::vector<Vector<3>>& touching, const Vector<3>& side,
            const Vector<3>& normal) {
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  for (const Vector<3>& point : touching) square += point * point.transpose();
  const Vector<3> longest =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(square).eigenvectors().col(2);
  double least = std::numeric_limits<double>::infinity();
  for (const Vector<3>& axis : {side, Vector<3>(side.cross(normal)), longest}) {
    const Vector<3> in_plane = axis - normal.dot(axis) * normal;
    if (!(in_plane.norm() > 1e-3)) continue;
    const Vector<3> a = in_plane.normalized();
    const Vector<2> along = range(touching, a), across = range(touching, normal.cross(a));
    const double area = (along[1] - along[0]) * (across[1] - across[0]);
    if (!(area < least * (1 - 1e-6))) continue;  // rounding does not turn it
    least = area;
    pad.axis = a;
    pad.reach = {std::min(-along[0], along[1]), std::min(-across[0], across[1])};
  }
  // Of points in a row, what rounding leaves across it.
  pad.reach = (pad.reach.array() > 1e-9 * pad.reach.maxCoeff()).select(pad.reach, 0);
}

/// One contact of all that touches; without a pad where that is a single point.
Contact<3> pad_at(const Print& print, const Vector<3>& direction, const Vector<3>& side) {
  const auto count = static_cast<double>(print.centres.size());
  Contact<3> mean;
  for (const Meeting& meeting : print.centres) {
    const Contact<3> each = contact_at(meeting, direction);
    mean.position += each.position / count;
    mean.normal += each.normal / count;
  }
  // Normals along the surface that the rays graze may cancel each other.
  mean.normal = mean.normal.norm() > 1e-6 ? mean.normal.normalized() : direction;
  const auto in_plane = [&](const Meeting& meeting) -> Vector<3> {
    const Vector<3> point = meeting.point - mean.position;
    return point - mean.normal.dot(point) * mean.normal;
  };
  Pad pad;
  for (const Meeting& meeting : print.centres) pad.points.push_back(in_plane(meeting));
  pad.shares.assign(pad.points.size(), 1 / count);
  std::vector<Vector<3>> touching = pad.points;
  for (const Meeting& meeting : print.corners) touching.push_back(in_plane(meeting));
  settle(pad, touching, side, mean.normal);
  if (pad.points.size() > 1 || pad.reach.maxCoeff() > 0) mean.pad = std::move(pad);
  return mean;
}

void close(Side& side, const ParallelJaw& jaw, const Surface& surface) {
  const Vector<3> direction = direction_of(jaw, side.x);
  const Print print = print_of(side, jaw, surface);
  const auto add = [&](Contact<3> contact, bool is_behind) {
    contact.friction = jaw.friction;
    contact.finger = side.name;
    side.grip.add(std::move(contact), is_behind);
  };
  const auto behind = [&](const Meeting& each) { return from_behind(each, direction); };
  if (jaw.contact == JawContact::pads) {
    if (!print.centres.empty())
      add(pad_at(print, direction, jaw.pose.orientation * Vector<3>::UnitY()),
          std::any_of(print.centres.begin(), print.centres.end(), behind));
    return;
  }
  for (const Meeting& meeting : print.centres) {
    Contact<3> contact = contact_at(meeting, direction);
    contact.torsion = jaw.torsion;
    contact.share = 1.0 / jaw.samples;
    add(std::move(contact), behind(meeting));
  }
}

Grip grip_of(const ParallelJaw& jaw, const Surface& surface) {
  Side left{"left", -1}, right{"right", 1};
  close(left, jaw, surface);
  close(right, jaw, surface);
  if (left.inside && right.inside)
    throw MissedGrip("both pads begin inside the object: open wider, or move the gripper");
  for (const Side& side : {left, right})
    if (side.inside)
      throw MissedGrip("the " + side.name +
                       " pad begins inside the object: open wider, or move the gripper");
  if (left.grip.contacts.empty() && right.grip.contacts.empty())
    throw MissedGrip("the pads meet nothing: the object is not between them");
  for (const Side& side : {left, right})
    if (side.grip.contacts.empty())
      throw MissedGrip("the " + side.name + " pad meets nothing, the other one does");
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
    grip.add(std::move(contact), from_behind(*at.meeting, direction));
  }
  return grip;
}

/// The rim of a cup that lies on the surface.
Pad rim(double diameter, const Vector<3>& normal) {
  constexpr int points = 8;
  const Eigen::Matrix<double, 3, 2> plane = tangents(normal);
  Pad pad;
  for (int k = 0; k < points; ++k) {
    const double angle = 2 * std::numbers::pi * k / points;
    pad.points.emplace_back(diameter / 2 * plane * Vector<2>(std::cos(angle), std::sin(angle)));
  }
  pad.shares.assign(points, 1.0 / points);
  pad.axis = plane.col(0);
  pad.reach = Vector<2>::Constant(diameter / 2 / std::numbers::sqrt2);
  return pad;
}

Grip grip_of(const Suction& suction, const Surface& surface) {
  Grip grip;
  const Vector<3> direction = suction.pose.orientation * suction.direction;
  for (std::size_t i = 0; i < suction.cups.size(); ++i) {
    const std::string name = "cup " + std::to_string(i);
    const Touch at = touch(surface, suction.pose.position + suction.pose.orientation * suction.cups[i],
                           direction, std::numeric_limits<double>::infinity(), name);
    if (at.inside) throw MissedGrip(name + " begins inside the object: begin farther out");
    if (!at.meeting) throw MissedGrip(name + " meets nothing: it passes the object");
    Contact<3> contact = contact_at(*at.meeting, direction);
    contact.friction = suction.friction;
    contact.pad = rim(suction.diameter, contact.normal);
    contact.finger = name;
    grip.add(std::move(contact), from_behind(*at.meeting, direction));
  }
  return grip;
}

/// "contacts 0 to 15 and 20 meet"
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
  return text + (count == 1 ? " meets" : " meet");
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
                       " the surface from behind: it is open there, or faces the wrong way");
    return std::move(grip.contacts);
  } catch (const MissedGrip& missed) {
    throw MissedGrip(missed.what() + where(surface));
  }
}

Mechanism<3> mechanism(const Gripper& gripper) {
  const auto* jaw = std::get_if<ParallelJaw>(&gripper);
  if (!jaw) return {};
  return {.kind = DriveKind::coupled,
          .fingers = {{"left", direction_of(*jaw, -1), jaw->max_force},
                      {"right", direction_of(*jaw, 1), jaw->max_force}}};
}

std::vector<Pull<3>> pulls(const Gripper& gripper, const std::vector<Contact<3>>& contacts) {
  std::vector<Pull<3>> pulls;
  if (const auto* suction = std::get_if<Suction>(&gripper))
    for (const Contact<3>& contact : contacts) pulls.push_back({contact, suction->adhesion});
  return pulls;
}

}  // namespace poise
