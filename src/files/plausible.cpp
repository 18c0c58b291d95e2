#include "files/plausible.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "shape/number_text.hpp"

namespace poise {
namespace {

constexpr double degree = 3.14159265358979323846 / 180;

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

void check_units(Doubts& doubts, const Grasp<2>& grasp, bool has_mass) {
  const double weight = grasp.object().weight, radius = grasp.radius();
  if (weight < 1e-4 || weight > 1e5)
    doubts.add(has_mass ? "object.mass" : "object.weight",
               "makes a weight of " + number_text(weight, 3) +
                   " N: is the unit right (weight in N, mass in kg)?");
  if (radius < 1e-4 || radius > 5)
    doubts.add("contacts", "the farthest is " + number_text(radius, 3) +
                               " m from the centre of mass: is length_unit right?");
}

void check_com(Doubts& doubts, const Vector<2>& com, const Shape& shape) {
  const std::vector<Vector<2>> line = outline(shape);
  Vector<2> lower = line.front(), upper = lower;
  for (const auto& point : line) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  if ((com.array() < lower.array()).any() || (com.array() > upper.array()).any())
    doubts.add("object.com", "lies outside the shape");
}

/// A normal that is written in the file, against the shape, or else against the centre of mass.
void check_normal(Doubts& doubts, const std::string& contact, const GraspFile& file,
                  const Vector<2>& position, const Vector<2>& normal) {
  if (file.shape) {
    const Boundary<2> b = boundary(*file.shape, position);
    if (b.distance > boundary_tolerance * size(*file.shape)) {
      doubts.add(contact + ".position",
                 "is " + number_text(b.distance, 3) + " m from the boundary of the shape");
    } else if (b.corner.empty()) {
      const double angle = std::acos(std::clamp(b.normal.dot(normal), -1.0, 1.0)) / degree;
      if (angle > 5)
        doubts.add(contact + ".normal", "is " + number_text(angle, 3) +
                                            " degrees away from the inward normal of the shape");
      return;
    }
  }
  if (normal.dot(file.object.com - position) < 0)
    doubts.add(contact + ".normal",
               "points away from the centre of mass: if it points out of the object, write "
               "normals: outward");
}

}  // namespace

std::vector<std::string> doubts(const GraspFile& file, const Grasp<2>& grasp, const Field& root) {
  Doubts doubts(root);
  check_units(doubts, grasp, root.follow("object").find("mass").has_value());
  if (file.shape) check_com(doubts, file.object.com, *file.shape);

  std::map<std::pair<double, double>, std::size_t> positions;
  for (std::size_t i = 0; i < file.contacts.size(); ++i) {
    const std::string contact = "contacts[" + std::to_string(i) + "]";
    const Contact<2>& c = grasp.contacts()[i];
    if (root.follow(contact).find("normal"))
      check_normal(doubts, contact, file, c.position, c.normal);
    if (file.contacts[i].friction > 3)
      doubts.add(contact + ".friction", "is " + number_text(file.contacts[i].friction) +
                                            ", uncommonly high: is it an angle?");
    const auto [first, is_new] = positions.try_emplace({c.position.x(), c.position.y()}, i);
    if (!is_new)
      doubts.add(contact + ".position",
                 "is the same as that of contacts[" + std::to_string(first->second) + "]");
  }
  return doubts.lines;
}

}  // namespace poise
