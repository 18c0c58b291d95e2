#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <sstream>
#include <string_view>

#include "dual/scaled_hand.hpp"
#include "poise/grasp.hpp"

namespace poise {
namespace {

std::string text(double value) {
  std::ostringstream out;
  out.precision(12);
  out << value;
  return out.str();
}

/// Where a number stands: its path is written only when something is wrong with it.
struct Place {
  const char* field;
  std::size_t index = static_cast<std::size_t>(-1);
  int component = -1;
  const char* list = "contacts";

  std::string path() const {
    std::string path;
    if (index != static_cast<std::size_t>(-1))
      path = std::string(list) + "[" + std::to_string(index) + "].";
    path += field;
    if (component >= 0) path += "[" + std::to_string(component) + "]";
    return path;
  }
};

[[noreturn, gnu::cold]] void refuse(double value, const Place& place, const char* expected) {
  throw InvalidGrasp(place.path(), "is " + text(value) + ", must be " + expected);
}

/// Throws unless `value` is finite with a finite square, and `in_range`. Inline, so that no place
/// is made where nothing is wrong: making a grasp should cost no more than a hold.
[[gnu::always_inline]] inline void check(double value, bool in_range, const Place& place,
                                         const char* expected) {
  if (!(std::isfinite(value * value) && in_range)) refuse(value, place, expected);
}

template <int Dim>
[[noreturn, gnu::cold]] void refuse(const Vector<Dim>& value, Place place) {
  for (int k = 0; k < Dim; ++k) {
    Place component = place;
    component.component = k;
    check(value[k], true, component, "a finite number");
  }
  throw InvalidGrasp(place.path(), "is too long: its square overflows");
}

template <int Dim>
[[gnu::always_inline]] inline void check(const Vector<Dim>& value, const Place& place) {
  if (!std::isfinite(value.squaredNorm())) refuse<Dim>(value, place);
}

/// A mean of unit normals below this length points nowhere.
constexpr double least_mean_normal = 0.1;
/// What rounding may make of a unit force at a right angle to a direction.
constexpr double across = 1e-9;

void check(const Pad& pad, std::size_t i) {
  const auto path = [&](const std::string& field) {
    return "contacts[" + std::to_string(i) + "].pad." + field;
  };
  if (pad.points.empty()) throw InvalidGrasp(path("points"), "is empty, must hold a point");
  if (pad.shares.size() != pad.points.size())
    throw InvalidGrasp(path("shares"), "has " + std::to_string(pad.shares.size()) +
                                           " numbers, must have one for each of the " +
                                           std::to_string(pad.points.size()) + " points");
  double sum = 0;
  for (std::size_t k = 0; k < pad.points.size(); ++k) {
    const std::string which = "[" + std::to_string(k) + "]";
    if (!std::isfinite(pad.points[k].squaredNorm()))
      throw InvalidGrasp(path("points") + which, "must be finite");
    if (!(pad.shares[k] > 0 && pad.shares[k] <= 1))
      throw InvalidGrasp(path("shares") + which,
                         "is " + text(pad.shares[k]) + ", must be above 0 and at most 1");
    sum += pad.shares[k];
  }
  if (!(std::abs(sum - 1) <= 1e-6))
    throw InvalidGrasp(path("shares"), "add up to " + text(sum) + ", must add up to 1");
  if (!std::isfinite(pad.axis.squaredNorm()) || !(pad.axis.cwiseAbs().maxCoeff() > 0))
    throw InvalidGrasp(path("axis"), "must be a direction");
  if (!(pad.reach.minCoeff() >= 0) || !std::isfinite(pad.reach.squaredNorm()))
    throw InvalidGrasp(path("reach"), "must be lengths of at least 0");
}

template <int Dim>
void check(const Contact<Dim>& contact, std::size_t i) {
  check<Dim>(contact.position, {"position", i});
  check<Dim>(contact.normal, {"normal", i});
  if (!(contact.normal.cwiseAbs().maxCoeff() > 0))
    throw InvalidGrasp(Place{"normal", i}.path(),
                       "has no length, must point from the finger inwards");
  check(contact.friction, contact.friction >= 0, {"friction", i}, "at least 0");
  check(contact.min_normal, contact.min_normal >= 0, {"min_normal", i}, "at least 0");
  const double max = contact.max_normal;
  if (max != std::numeric_limits<double>::infinity())
    check(max, max >= 0, {"max_normal", i}, "at least 0");
  if (max < contact.min_normal)
    throw InvalidGrasp(
        Place{"max_normal", i}.path(),
        "is " + text(max) + ", must be at least min_normal, " + text(contact.min_normal));
  check(contact.share, contact.share > 0 && contact.share <= 1, {"share", i},
        "above 0 and at most 1");
  const double torsion = contact.torsion;
  if (Dim == 2) check(torsion, torsion == 0, {"torsion", i}, "0 in the plane");
  check(torsion, torsion >= 0, {"torsion", i}, "at least 0");
  check(torsion, torsion == 0 || contact.friction > 0, {"torsion", i},
        "0 where there is no friction");
  // The solver divides by it.
  check(torsion > 0 ? contact.friction / torsion : 0, true, {"torsion", i},
        "less small against the friction");
  if (!contact.pad) return;
  if (Dim == 2)
    throw InvalidGrasp(Place{"pad", i}.path(), "is for space, must be two contacts in the plane");
  check(*contact.pad, i);
  check(torsion, torsion == 0, {"torsion", i}, "0 for a pad, whose points resist the twist");
  check(contact.share, contact.share == 1, {"share", i}, "1 for a pad");
}

/// Of a normal whose length is above 0, whatever its size.
template <int Dim>
Vector<Dim> unit(const Vector<Dim>& normal) {
  const double squared = normal.squaredNorm();
  const bool plain = squared > 1e-200 && squared < 1e200;
  return plain ? Vector<Dim>(normal / std::sqrt(squared)) : Vector<Dim>(normal.stableNormalized());
}

/// Puts a pad into the plane across the normal, with an axis of length 1 and shares that add up
/// to 1. The distance of its farthest point from the center.
double settle(Pad& pad, const Contact<3>& contact, const Vector<3>& center) {
  const Vector<3>& n = contact.normal;
  pad.axis = unit<3>(pad.axis);
  pad.axis -= n.dot(pad.axis) * n;
  if (!(pad.axis.norm() > 1e-6))
    throw InvalidGrasp("pad.axis", "is along the normal, must be in the pad's plane");
  pad.axis.normalize();
  double sum = 0, farthest = 0;
  for (const double share : pad.shares) sum += share;
  for (double& share : pad.shares) share /= sum;
  for (Vector<3>& point : pad.points) {
    point -= n.dot(point) * n;
    farthest = std::max(farthest, (contact.position + point - center).norm());
  }
  return farthest;
}

/// A unit vector, whether or not a contact of the finger can push along it.
template <int Dim>
bool can_push(const Hand<Dim>& hand, std::size_t finger, const Vector<Dim>& along) {
  for (std::size_t i = 0; i < hand.contacts().size(); ++i) {
    const Contact<Dim>& contact = hand.contacts()[i];
    const double straight = contact.normal.dot(along);
    const double beside = (along - straight * contact.normal).norm();
    if (hand.finger_of(i) == finger && straight + contact.friction * beside > -across) return true;
  }
  return false;
}

[[noreturn, gnu::cold]] void refuse_twice(const std::string& name, const std::string& path,
                                          const std::string& expected) {
  throw InvalidGrasp(path, "is \"" + name + "\" once more, must be " + expected);
}

template <int Dim>
void check(const Finger<Dim>& finger, const Hand<Dim>& hand, std::size_t index) {
  const std::string path = "fingers." + finger.name + ".closing";
  if (!std::isfinite(finger.closing.squaredNorm())) throw InvalidGrasp(path, "must be finite");
  if (finger.closing.cwiseAbs().maxCoeff() > 0 && !can_push<Dim>(hand, index, hand.closing(index)))
    throw InvalidGrasp(path,
                       "points away from the object, where no contact of the finger can "
                       "push: must be the direction in which it pushes");
}

template <int Dim>
const std::vector<Load<Dim>>& checked(const std::vector<Load<Dim>>& loads) {
  if (loads.empty()) throw InvalidGrasp("loads", "is empty, must hold at least one load");
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const Load<Dim>& load = loads[k];
    const auto place = [k](const char* field) { return Place{field, k, -1, "loads"}; };
    check(load.weight, load.weight >= 0, place("weight"), "at least 0");
    check<Dim>(load.com, place("com"));
    if (!load.fixed.allFinite()) throw InvalidGrasp(place("fixed").path(), "must be finite");
    check(load.lift, true, place("lift"), "a finite number");
    check<Dim>(load.acceleration, place("acceleration"));
    check(load.weight, load.turning() != 0 || !load.still().isZero(0), place("weight"),
          "above 0 where nothing else acts");
  }
  return loads;
}

/// The contact's columns of G about the origin: the normal force first.
Eigen::Matrix<double, 3, 2> columns(const Contact<2>& contact) {
  const Vector<2> r = contact.position, n = contact.normal, t(-n.y(), n.x());
  Eigen::Matrix<double, 3, 2> c;
  c << n, t, r.x() * n.y() - r.y() * n.x(), r.x() * t.y() - r.y() * t.x();
  return c;
}
Eigen::Matrix<double, 6, 4> columns(const Contact<3>& contact) {
  Eigen::Matrix3d frame;
  frame << contact.normal, tangents(contact.normal);
  Eigen::Matrix<double, 6, 4> c = Eigen::Matrix<double, 6, 4>::Zero();
  c.topLeftCorner<3, 3>() = frame;
  for (int k = 0; k < 3; ++k) c.col(k).tail<3>() = contact.position.cross(frame.col(k));
  c.col(3).tail<3>() = contact.normal;
  return c;
}

}  // namespace

// Duff et al., Building an orthonormal basis, revisited (2017): no normal is special.
Eigen::Matrix<double, 3, 2> tangents(const Vector<3>& n) {
  const double sign = std::copysign(1, n.z()), a = -1 / (sign + n.z()), b = n.x() * n.y() * a;
  Eigen::Matrix<double, 3, 2> t;
  t << 1 + sign * n.x() * n.x() * a, b,    //
      sign * b, sign + n.y() * n.y() * a,  //
      -sign * n.x(), -n.y();
  return t;
}

Pad rectangular_pad(const Vector<2>& size, const Vector<3>& axis, const Vector<3>& normal,
                    int grid) {
  const Vector<3> n = normal.normalized();
  const Vector<3> a = (axis - n.dot(axis) * n).normalized(), b = n.cross(a);
  Pad pad{.axis = a, .reach = size / 2};
  const double share = 1.0 / (grid * grid);
  for (int j = 0; j < grid; ++j)
    for (int i = 0; i < grid; ++i) {
      const double x = (i + 0.5) / grid - 0.5, y = (j + 0.5) / grid - 0.5;
      pad.points.emplace_back(x * size.x() * a + y * size.y() * b);
      pad.shares.push_back(share);
    }
  return pad;
}

template <int Dim>
Hand<Dim>::Hand(std::vector<Contact<Dim>> contacts, const Vector<Dim>& center, double safety,
                Mechanism<Dim> mechanism)
    : contacts_(std::move(contacts)), center_(center), mechanism_(std::move(mechanism)) {
  check<Dim>(center, {"center"});
  check(safety, safety >= 1, {"safety"}, "at least 1");
  if (contacts_.empty()) throw InvalidGrasp("contacts", "is empty, must hold at least one contact");
  fingers_.reserve(contacts_.size());
  finger_of_.reserve(contacts_.size());
  std::map<std::string_view, std::size_t> labels;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    Contact<Dim>& contact = contacts_[i];
    check<Dim>(contact, i);
    contact.normal = unit<Dim>(contact.normal);
    contact.friction /= safety;
    contact.torsion /= safety;
    double distance = (contact.position - center_).norm();
    if constexpr (Dim == 3)
      if (contact.pad) distance = std::max(distance, settle(*contact.pad, contact, center_));
    if (!std::isfinite(distance))
      throw InvalidGrasp(Place{"position", i}.path(), "is too far from the centre of mass");
    radius_ = std::max(radius_, distance);
    const bool own = contact.finger.empty();  // a finger of its own, named after the contact
    if (own) contact.finger = std::to_string(i);
    const std::size_t finger =
        own ? fingers_.size() : labels.try_emplace(contact.finger, fingers_.size()).first->second;
    finger_of_.push_back(finger);
    if (finger == fingers_.size()) fingers_.push_back(contact.finger);
  }
  // The solver squares the moment of a soft finger beside the force at the radius.
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    check(contacts_[i].torsion,
          contacts_[i].torsion <= 1e12 * contacts_[i].friction * (radius_ > 0 ? radius_ : 1),
          {"torsion", i}, "at most 1e12 times friction times the size of the grasp");
  check_mechanism();
  scaled_ = std::make_shared<const Scaled>(contacts_, center_, radius_);
  driven_ = std::make_shared<const Driven>(*this);
}

template <int Dim>
void Hand<Dim>::check_mechanism() {
  for (const Contact<Dim>& contact : contacts_) is_general_ = is_general_ || contact.pad;
  const auto index_of = [&](const std::string& name, const std::string& path) {
    const auto finger = std::find(fingers_.begin(), fingers_.end(), name);
    if (finger == fingers_.end())
      throw InvalidGrasp(path, "is \"" + name + "\", must be the finger of a contact");
    if (std::find(finger + 1, fingers_.end(), name) != fingers_.end())
      throw InvalidGrasp(path,
                         "is \"" + name +
                             "\", which two fingers are called: the contact of that number must be "
                             "given a label");
    return static_cast<std::size_t>(finger - fingers_.begin());
  };
  const auto check_limit = [&](double most, const std::string& path) {
    if (!(most > 0)) throw InvalidGrasp(path, "is " + text(most) + ", must be above 0");
    is_general_ = is_general_ || std::isfinite(most);
  };
  const auto is_named_before = [](const auto& list, std::size_t k, const auto& name) {
    const auto named = [&](const auto& other) {
      return std::invoke(name, other) == std::invoke(name, list[k]);
    };
    return std::any_of(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(k), named);
  };
  for (std::size_t k = 0; k < mechanism_.fingers.size(); ++k) {
    const Finger<Dim>& finger = mechanism_.fingers[k];
    const std::string path = "fingers." + finger.name;
    check<Dim>(finger, *this, index_of(finger.name, path));
    if (is_named_before(mechanism_.fingers, k, &Finger<Dim>::name))
      refuse_twice(finger.name, path, "named once");
    if (mechanism_.kind == DriveKind::listed && std::isfinite(finger.max_force))
      throw InvalidGrasp(path + ".max_force",
                         "is given as well as a list of drives, must be `max` "
                         "of a drive");
    check_limit(finger.max_force, path + ".max_force");
  }
  if (mechanism_.kind != DriveKind::listed) return;
  if (mechanism_.drives.empty())
    throw InvalidGrasp("drives", "is empty, must hold at least one drive");
  for (std::size_t a = 0; a < mechanism_.drives.size(); ++a) {
    const std::string path = "drives[" + std::to_string(a) + "]";
    const Drive<Dim>& drive = mechanism_.drives[a];
    if (is_named_before(mechanism_.drives, a, &Drive<Dim>::name))
      refuse_twice(drive.name, path + ".name", "the name of no other drive");
    check_limit(drive.max, path + ".max");
    if (drive.moves.empty()) throw InvalidGrasp(path + ".moves", "is empty, must name a finger");
    for (std::size_t k = 0; k < drive.moves.size(); ++k) {
      const auto& moved = drive.moves[k];
      const std::string which = path + ".moves[" + std::to_string(k) + "]";
      index_of(moved.finger, which);
      if (is_named_before(drive.moves, k, &Drive<Dim>::Moved::finger))
        refuse_twice(moved.finger, which, "named once");
      if (!std::isfinite(moved.twist.squaredNorm()) || !(moved.twist.cwiseAbs().maxCoeff() > 0))
        throw InvalidGrasp(which, "must be moved: its twist is 0 or not finite");
    }
  }
}

template <int Dim>
double Hand<Dim>::length() const {
  return scaled_->length;
}

template <int Dim>
Vector<Dim> Hand<Dim>::closing(std::size_t finger) const {
  for (const Finger<Dim>& given : mechanism_.fingers)
    if (given.name == fingers_[finger] && given.closing.cwiseAbs().maxCoeff() > 0)
      return unit<Dim>(given.closing);
  Vector<Dim> sum = Vector<Dim>::Zero();
  double shares = 0;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (finger_of_[i] != finger) continue;
    sum += contacts_[i].share * contacts_[i].normal;
    shares += contacts_[i].share;
  }
  if (!(sum.norm() >= least_mean_normal * shares)) return Vector<Dim>::Zero();
  return sum.normalized();
}

template <int Dim>
std::vector<Drive<Dim>> Hand<Dim>::drives() const {
  if (mechanism_.kind == DriveKind::listed) return mechanism_.drives;
  const bool coupled = mechanism_.kind == DriveKind::coupled;
  std::vector<Drive<Dim>> drives;
  for (std::size_t k = 0; k < fingers_.size(); ++k) {
    if (k == 0 || !coupled) drives.push_back({coupled ? "all" : fingers_[k], {}});
    Drive<Dim>& drive = drives.back();
    typename Drive<Dim>::Moved moved{fingers_[k], Twist<Dim>::Zero()};
    moved.twist.template head<Dim>() =
        closing(k) / (coupled ? static_cast<double>(fingers_.size()) : 1);
    drive.moves.push_back(std::move(moved));
    for (const Finger<Dim>& given : mechanism_.fingers)
      if (given.name == fingers_[k]) drive.max = std::min(drive.max, given.max_force);
  }
  return drives;
}

const char* to_string(DriveKind kind) {
  constexpr const char* names[] = {"each", "coupled", "listed"};
  return names[static_cast<int>(kind)];
}

template <int Dim>
Wrench<Dim> wrench_of(const Vector<Dim>& force, const Vector<Dim>& at) {
  Wrench<Dim> wrench;
  if constexpr (Dim == 2)
    wrench << force, at.x() * force.y() - at.y() * force.x();
  else
    wrench << force, at.cross(force);
  return wrench;
}

template <int Dim>
Wrench<Dim> Load<Dim>::still() const {
  return wrench_of<Dim>(weight / standard_gravity * acceleration, com) + fixed;
}

template <int Dim>
Wrench<Dim> Load<Dim>::at(const Vector<Dim>& up) const {
  return wrench_of<Dim>(turning() * up, com) + still();
}

template <int Dim>
double Load<Dim>::size(double length) const {
  const Wrench<Dim> wrench = still();
  const Vector<Dim> force = wrench.template head<Dim>();
  const double moment = (wrench - wrench_of<Dim>(force, com)).norm();
  return std::abs(turning()) + force.norm() + moment / length;
}

template <int Dim>
template <std::same_as<std::vector<Load<Dim>>> Loads>
Grasp<Dim>::Grasp(Loads loads, std::vector<Contact<Dim>> contacts, double safety,
                  Mechanism<Dim> mechanism)
    : Hand<Dim>(std::move(contacts), checked(loads).front().com, safety, std::move(mechanism)),
      loads_(std::move(loads)) {
  for (const Load<Dim>& load : loads_) size_ = std::max(size_, load.size(this->length()));
}

template <int Dim>
Grasp<Dim>::Grasp(const Load<Dim>& load, std::vector<Contact<Dim>> contacts, double safety,
                  Mechanism<Dim> mechanism)
    : Grasp(std::vector<Load<Dim>>{load}, std::move(contacts), safety, std::move(mechanism)) {}

template <int Dim>
Eigen::Matrix<double, wrench_size<Dim>, Eigen::Dynamic> grasp_matrix(const Hand<Dim>& hand) {
  const auto& contacts = hand.contacts();
  constexpr int width = contact_size<Dim>;
  Eigen::Matrix<double, wrench_size<Dim>, Eigen::Dynamic> G(
      wrench_size<Dim>, width * static_cast<int>(contacts.size()));
  for (std::size_t i = 0; i < contacts.size(); ++i)
    G.template middleCols<width>(width * static_cast<int>(i)) = columns(contacts[i]);
  return G;
}

template class Hand<2>;
template class Hand<3>;
template struct Load<2>;
template struct Load<3>;
template Wrench<2> wrench_of(const Vector<2>&, const Vector<2>&);
template Wrench<3> wrench_of(const Vector<3>&, const Vector<3>&);
template class Grasp<2>;
template class Grasp<3>;
template Grasp<2>::Grasp(std::vector<Load<2>>, std::vector<Contact<2>>, double, Mechanism<2>);
template Grasp<3>::Grasp(std::vector<Load<3>>, std::vector<Contact<3>>, double, Mechanism<3>);
template Eigen::Matrix<double, 3, Eigen::Dynamic> grasp_matrix<2>(const Hand<2>&);
template Eigen::Matrix<double, 6, Eigen::Dynamic> grasp_matrix<3>(const Hand<3>&);

}  // namespace poise
