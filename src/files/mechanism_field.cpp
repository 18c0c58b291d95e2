#include "files/mechanism_field.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "shape/number_text.hpp"

namespace poise {
namespace {

constexpr int most_cells = 64;  // of a grid along each side

template <int Dim>
Vector<Dim> read_direction(const Field& field) {
  const Vector<Dim> direction = field.vector<Dim>();
  if (!(direction.stableNorm() > 0)) field.fail("has no length, must be a direction");
  return direction.stableNormalized();
}

/// Of points without a shape: how far they extend from their mean along a direction.
double extent(const Pad& pad, const Vector<3>& direction) {
  Vector<3> mean = Vector<3>::Zero();
  for (std::size_t k = 0; k < pad.points.size(); ++k) mean += pad.shares[k] * pad.points[k];
  double most = 0;
  for (const Vector<3>& point : pad.points)
    most = std::max(most, std::abs(direction.dot(point - mean)));
  return most;
}

Pad read_points(const Field& field, double unit, const Vector<3>& normal) {
  Pad pad;
  const Field points = field.get("points", "a list of [x, y, z]");
  for (const Field& point : points.list()) pad.points.emplace_back(unit * point.vector<3>());
  if (pad.points.empty()) points.fail("is empty, must hold a point");
  if (const auto shares = field.find("shares")) {
    double sum = 0;
    for (const Field& share : shares->list()) {
      pad.shares.push_back(share.above_zero());
      sum += pad.shares.back();
    }
    if (pad.shares.size() != pad.points.size())
      shares->fail("has " + std::to_string(pad.shares.size()) + " numbers, must have " +
                   std::to_string(pad.points.size()) + ", one for each point");
    if (!(std::abs(sum - 1) <= 1e-6))
      shares->fail("add up to " + number_text(sum) + ", must add up to 1");
  } else {
    pad.shares.assign(pad.points.size(), 1.0 / static_cast<double>(pad.points.size()));
  }
  pad.axis = tangents(normal.stableNormalized()).col(0);
  if (const auto axis = field.find("axis")) pad.axis = read_direction<3>(*axis);
  if (const auto reach = field.find("reach")) {
    pad.reach = unit * reach->vector<2>();
    if (pad.reach.minCoeff() < 0) reach->fail("must be lengths of at least 0");
    return pad;
  }
  const Vector<3> n = normal.stableNormalized(), a = (pad.axis - n.dot(pad.axis) * n).normalized();
  pad.reach = {extent(pad, a), extent(pad, n.cross(a))};
  return pad;
}

Pad read_rectangle(const Field& field, double unit, const Vector<3>& normal) {
  const Field size = field.get("size", "[along the axis, across it]");
  const Vector<2> lengths = unit * size.vector<2>();
  if (!(lengths.minCoeff() > 0)) size.fail("must be lengths above 0");
  int grid = 4;
  if (const auto cells = field.find("grid")) {
    const double number = cells->number();
    if (!(number >= 1 && number <= most_cells) || number != std::floor(number))
      cells->fail("is " + number_text(number) + ", must be a whole number from 1 to 64");
    grid = static_cast<int>(number);
  }
  const Field axis = field.get("axis", "[x, y, z], a direction in the pad's plane");
  const Vector<3> a = read_direction<3>(axis), n = normal.stableNormalized();
  if (!((a - n.dot(a) * n).norm() > 1e-6))
    axis.fail("is along the normal, must be in the pad's plane");
  return rectangular_pad(lengths, a, n, grid);
}

/// A screw of unit speed.
template <int Dim>
void read_motion(const Field& field, double unit, Drive<Dim>& drive, Twist<Dim>& twist) {
  const auto along = field.find("along"), about = field.find("about");
  if (along && about) about->fail("is given as well as along, must be one of them");
  if (!about) {
    twist.template head<Dim>() =
        read_direction<Dim>(field.get("along", std::string(coordinates<Dim>) + ", or about"));
    return;
  }
  drive.turns = true;
  about->mapping({"axis", "through"});
  const Field axis = about->get("axis", "[x, y, z]");
  const Vector<3> omega = read_direction<3>(axis);
  const Field through = about->get("through", coordinates<Dim>);
  Vector<3> at = Vector<3>::Zero();
  if constexpr (Dim == 2) {
    if (!(omega.head<2>().norm() <= 1e-9))
      axis.fail("must be [0, 0, 1] or [0, 0, -1] in the plane");
    if (through.list().size() == 3)
      at = unit * through.vector<3>();
    else
      at.head<2>() = unit * through.vector<2>();
  } else {
    at = unit * through.vector<3>();
  }
  const Vector<3> v = at.cross(omega);
  if constexpr (Dim == 2)
    twist << v.x(), v.y(), omega.z();
  else
    twist << v, omega;
}

template <int Dim>
Drive<Dim> read_drive(const Field& field, double unit) {
  field.mapping({"name", "moves", "along", "about", "max"});
  Drive<Dim> drive;
  Twist<Dim> twist = Twist<Dim>::Zero();
  read_motion<Dim>(field, unit, drive, twist);
  if (const auto max = field.find("max")) drive.max = max->above_zero();
  const std::string some_fingers = "a list of fingers";
  const Field moves = field.get("moves", some_fingers);
  for (const Field& finger : moves.list(some_fingers))
    drive.moves.push_back({finger.text(), twist});
  if (drive.moves.empty()) moves.fail("is empty, must name a finger");
  const auto name = field.find("name");
  drive.name = name ? name->text() : drive.moves.front().finger;
  return drive;
}

/// What is said of a finger, with nothing said yet if it is new.
template <int Dim>
Finger<Dim>& finger_of(Mechanism<Dim>& mechanism, const std::string& name) {
  for (Finger<Dim>& finger : mechanism.fingers)
    if (finger.name == name) return finger;
  mechanism.fingers.push_back({.name = name});
  return mechanism.fingers.back();
}

}  // namespace

Pad read_pad(const Field& field, double unit, const Vector<3>& normal) {
  field.mapping({"size", "axis", "grid", "points", "shares", "reach"});
  if (!field.find("points")) {
    for (const char* key : {"shares", "reach"})
      if (const auto stray = field.find(key)) stray->fail("goes with points, must be left out");
    return read_rectangle(field, unit, normal);
  }
  for (const char* key : {"size", "grid"})
    if (const auto stray = field.find(key)) stray->fail("is given as well as points");
  return read_points(field, unit, normal);
}

template <int Dim>
Mechanism<Dim> read_mechanism(const Field& root, double unit,
                              const std::vector<Contact<Dim>>& contacts, Mechanism<Dim> mechanism) {
  if (const auto drives = root.find("drives")) {
    if (drives->is_text()) {
      mechanism.kind =
          drives->word({"each", "coupled"}) == "each" ? DriveKind::each : DriveKind::coupled;
    } else {
      mechanism.kind = DriveKind::listed;
      const std::string expected = "each, coupled or a list of drives";
      for (const Field& drive : drives->list(expected))
        mechanism.drives.push_back(read_drive<Dim>(drive, unit));
      if (mechanism.drives.empty()) drives->fail("is empty, must be " + expected);
    }
  }
  if (const auto fingers = root.find("fingers")) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const std::string& name = contacts[i].finger;
      if (name.empty() || std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name.empty() ? std::to_string(i) : name);
    }
    fingers->mapping(Keys(names.begin(), names.end()));
    for (const std::string& name : names) {
      const auto given = fingers->find(name);
      if (!given) continue;
      given->mapping({"closing", "max_force"});
      Finger<Dim>& finger = finger_of(mechanism, name);
      if (const auto closing = given->find("closing"))
        finger.closing = read_direction<Dim>(*closing);
      if (const auto force = given->find("max_force")) {
        if (mechanism.kind == DriveKind::listed)
          force->fail("is given as well as a list of drives, must be max of a drive");
        finger.max_force = force->above_zero();
      }
    }
  }
  return mechanism;
}

template Mechanism<2> read_mechanism(const Field&, double, const std::vector<Contact<2>>&,
                                     Mechanism<2>);
template Mechanism<3> read_mechanism(const Field&, double, const std::vector<Contact<3>>&,
                                     Mechanism<3>);

}  // namespace poise
