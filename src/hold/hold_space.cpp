#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "hold/solve.hpp"

namespace poise {
namespace {

std::string text(const Vector<3>& v) {
  std::ostringstream words;
  words.precision(4);
  words << '(' << rounded(v.x()) << ", " << rounded(v.y()) << ", " << rounded(v.z()) << ')';
  return words.str();
}

}  // namespace

std::string reason(const Hand<3>& hand, const Hold<3>& hold) {
  if (hold.holdable) return {};
  if (!hold.proven) return unproven;
  if (const std::string weak = weak_drives(hand, hold); !weak.empty()) return weak;
  const ScaledHand<3>& scaled = hand.scaled();
  const auto& contacts = hand.contacts();
  // -y is a motion that gravity drives; about the center, in radii, to tell a turn from a slide.
  const Twist<3> y = about_center(scaled, 1, hold.dual);
  const Vector<3> v = -y.head<3>(), omega = -y.tail<3>();
  std::string words = "it would ";
  bool between_points = false;
  if (omega.norm() <= 1e-6 * v.norm()) {
    words += "slide along " + text(v.normalized());
  } else {
    // The axis of the screw: where v + omega x r is along omega.
    const Vector<3> axis = omega.normalized();
    const Vector<3> at = scaled.center + scaled.length / omega.squaredNorm() * omega.cross(v);
    const bool slides = std::abs(v.dot(axis)) > 1e-6 * (v.norm() + omega.norm());
    words += slides ? "turn about and slide along " : "turn about ";
    std::vector<std::size_t> touched;
    for (std::size_t i = 0; i < contacts.size(); ++i)
      if ((contacts[i].position - at).cross(axis).norm() <= 1e-6 * hand.radius())
        touched.push_back(i);
    std::size_t other = touched.size();  // on the line, at another point than the first
    for (std::size_t k = touched.size(); k-- > 1;)
      if ((contacts[touched[k]].position - contacts[touched[0]].position).norm() >
          1e-6 * hand.radius())
        other = k;
    if (other < touched.size()) {
      words += "the line through contacts " + std::to_string(touched[0]) + " and " +
               std::to_string(touched[other]);
      between_points = !slides && touched.size() == contacts.size();
    } else if (!touched.empty()) {
      words += "the line through contact " + std::to_string(touched[0]) + " along " + text(axis);
    } else {
      words += "the line through " + text(at) + " m along " + text(axis);
    }
  }
  words += opposition(hand, y, hold);
  if (between_points)
    words += "; point contacts on one line cannot resist that torque: a soft finger (torsion) can";
  return words;
}

}  // namespace poise
