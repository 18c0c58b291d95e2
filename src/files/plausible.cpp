#include "files/plausible.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "dual/cone_pad.hpp"
#include "files/degrees.hpp"
#include "files/load_field.hpp"
#include "shape/number_text.hpp"

namespace poise {
namespace {

class Doubts {
  static constexpr std::size_t most = 100;  // nobody reads more

 public:
  explicit Doubts(const Field& root) : root_(root) {}

  void add(const std::string& path, const std::string& problem) {
    if (lines.size() == most) return;
    lines.push_back(located(root_.file(), root_.follow(path).place(), path, problem));
  }

  std::vector<std::string> lines{};

 private:
  const Field& root_;
};

void check_weight(Doubts& doubts, double weight, const Field& object) {
  if ((weight > 0 && weight < 1e-4) || weight > 1e5) {
    std::string key = "weight";
    for (const char* other : {"mass", "density", "inertial"})
      if (object.find(other)) key = other;
    doubts.add(object.path() + "." + key, "makes a weight of " + number_text(weight, 3) +
                                              " N: is the unit right (weight in N, mass in kg)?");
  }
}

template <int Dim>
void check_radius(Doubts& doubts, const Grasp<Dim>& grasp, const std::string& contacts) {
  if (const double radius = grasp.radius(); radius < 1e-4 || radius > 5)
    doubts.add(contacts, "the farthest is " + number_text(radius, 3) +
                             " m from the centre of mass: is length_unit right?");
}

template <int Dim>
void check_com(Doubts& doubts, const Vector<Dim>& com, const ShapeOf<Dim>& shape,
               const std::string& object) {
  if (!bounds(shape).contains(com)) doubts.add(object + ".com", "lies outside the shape");
}

bool is_mesh(const Shape& /*none*/) { return false; }
bool is_mesh(const Solid& solid) { return std::holds_alternative<MeshShape>(solid); }

/// How far a contact reaches: the middle of a pad on a curved surface is off that.
double reach_of(const Contact<2>& /*point*/) { return 0; }
double reach_of(const Contact<3>& contact) {
  double reach = 0;
  if (contact.pad)
    for (const Vector<3>& point : contact.pad->points) reach = std::max(reach, point.norm());
  return reach;
}

/// A normal that is written in the file, against the shape, or else against the centre of mass.
template <int Dim>
void check_normal(Doubts& doubts, const std::string& path, const std::optional<ShapeOf<Dim>>& shape,
                  const Contact<Dim>& contact, const Vector<Dim>& com) {
  if (shape) {
    const Boundary<Dim> b = boundary(*shape, contact.position);
    if (b.distance > boundary_tolerance * size(*shape) + reach_of(contact)) {
      doubts.add(path + ".position",
                 "is " + number_text(b.distance, 3) + " m from the boundary of the shape");
    } else if (b.corner.empty()) {
      const double angle = degrees(std::acos(std::clamp(b.normal.dot(contact.normal), -1.0, 1.0)));
      if (angle > 5)
        doubts.add(path + ".normal", "is " + number_text(angle, 3) +
                                         " degrees away from the inward normal of the shape");
      return;
    } else if (is_mesh(*shape)) {
      return;  // the com says nothing about the sides of an edge
    }
  }
  if (contact.normal.dot(com - contact.position) < 0)
    doubts.add(path + ".normal",
               "points away from the centre of mass: if it points out of the object, write "
               "normals: outward");
}

/// The greatest power of a force with normal force 1 while the finger moves with a twist of unit
/// speed about the object frame's origin.
double power(const Contact<2>& contact, const Twist<2>& y) {
  const Vector<2>&n = contact.normal, &r = contact.position;
  const Vector<2> v(y[0] - y[2] * r.y(), y[1] + y[2] * r.x());
  return n.dot(v) + contact.friction * (v - n.dot(v) * n).norm();
}
double power(const Contact<3>& contact, const Twist<3>& y) {
  if (contact.pad)
    return dual::pad_power(contact, dual::pad_slide<double>(contact, y), contact.friction);
  const Vector<3>&n = contact.normal, omega = y.tail<3>();
  const Vector<3> v = y.head<3>() + omega.cross(contact.position);
  return n.dot(v) +
         std::hypot(contact.friction * (v - n.dot(v) * n).norm(), contact.torsion * n.dot(omega));
}

/// Drives that only ever leave the object, so that the grip says nothing of them; and closing
/// directions that go against the normals.
template <int Dim>
void check_mechanism(Doubts& doubts, const Grasp<Dim>& grasp) {
  const Mechanism<Dim>& mechanism = grasp.mechanism();
  for (const Finger<Dim>& finger : mechanism.fingers) {
    bool against = finger.closing.cwiseAbs().maxCoeff() > 0;
    for (const Contact<Dim>& contact : grasp.contacts())
      if (contact.finger == finger.name)
        against = against && contact.normal.dot(finger.closing.stableNormalized()) < -1e-9;
    if (against)
      doubts.add("fingers." + finger.name + ".closing",
                 "goes against the inward normals of its contacts: does it point away from the "
                 "object?");
  }
  if (mechanism.kind != DriveKind::listed) return;
  for (std::size_t a = 0; a < mechanism.drives.size(); ++a) {
    bool opens = true;
    for (const auto& moved : mechanism.drives[a].moves)
      for (const Contact<Dim>& contact : grasp.contacts())
        if (contact.finger == moved.finger)
          opens = opens && power(contact, moved.twist) < -1e-9 * moved.twist.norm();
    if (opens)
      doubts.add(
          "drives[" + std::to_string(a) + "]." + (mechanism.drives[a].turns ? "about" : "along"),
          "moves its fingers away from the object: the grip does not count what it holds. "
          "Is it the way in which it closes?");
  }
}

}  // namespace

template <int Dim>
std::vector<std::string> doubts(const CommonFile<Dim>& file, const Grasp<Dim>& grasp,
                                const Field& root) {
  Doubts doubts(root);
  const std::vector<Load<Dim>>& loads = grasp.loads();
  const std::vector<std::string> paths = load_paths<Dim>(root);
  // A load takes from the object what its entry does not say, and then is that of others, too.
  const auto says = [&](std::size_t k, const Keys& keys) {
    const Field entry = root.follow(paths[k]);
    const bool given = std::any_of(keys.begin(), keys.end(),
                                   [&](auto key) { return entry.find(key).has_value(); });
    return given && (k == 0 || paths[k] != paths[k - 1]);
  };
  for (std::size_t k = 0; k < loads.size(); ++k)
    if (const bool own = says(k, {"weight", "mass", "density", "inertial"}); own || k == 0)
      check_weight(doubts, loads[k].weight, root.follow(own ? paths[k] : "object"));
  const bool gripped = root.find("gripper").has_value();
  check_radius(doubts, grasp, gripped ? "gripper" : "contacts");
  for (std::size_t k = 0; k < loads.size() && file.shape; ++k)
    if (const bool own = says(k, {"com", "inertial"}); own || k == 0)
      check_com<Dim>(doubts, loads[k].com, *file.shape, own ? paths[k] : "object");
  check_mechanism(doubts, grasp);

  std::map<std::vector<double>, std::size_t> positions;
  for (std::size_t i = 0; i < file.contacts.size(); ++i) {
    if (gripped && i > 0) break;  // they are all alike
    const std::string path = gripped ? "gripper" : "contacts[" + std::to_string(i) + "]";
    const Contact<Dim>& contact = grasp.contacts()[i];
    // But for rounding.
    const Vector<Dim> r = (contact.position / (1e-9 * grasp.length())).array().round();
    const auto [first, is_new] = positions.try_emplace({r.begin(), r.end()}, i);
    // A pull acts where the contact presses, against its normal.
    const bool is_pull = !is_new && contact.friction == 0 &&
                         contact.normal.dot(grasp.contacts()[first->second].normal) < -0.5;
    if (root.follow(path).find("normal") && !is_pull)
      check_normal<Dim>(doubts, path, file.shape, contact, grasp.center());
    if (file.contacts[i].friction > 3)
      doubts.add(path + ".friction", "is " + number_text(file.contacts[i].friction) +
                                         ", uncommonly high: is it an angle?");
    if constexpr (Dim == 3)
      if (grasp.radius() > 0 && file.contacts[i].torsion > grasp.radius())
        doubts.add(path + ".torsion",
                   "is " + number_text(file.contacts[i].torsion, 3) +
                       " m, more than the size of the grasp: it is a length, about the size of "
                       "the touching area");
    if (!is_new && !is_pull)
      doubts.add(path + ".position",
                 "is the same as that of contacts[" + std::to_string(first->second) + "]");
  }
  return doubts.lines;
}

template std::vector<std::string> doubts(const CommonFile<2>&, const Grasp<2>&, const Field&);
template std::vector<std::string> doubts(const CommonFile<3>&, const Grasp<3>&, const Field&);

}  // namespace poise
