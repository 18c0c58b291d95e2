#include "dual/scaled_hand.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "dual/cone_plane.hpp"
#include "dual/cone_space.hpp"
#include "dual/dual.hpp"
#include "dual/newton.hpp"
#include "dual/twist.hpp"

namespace poise {
namespace {

/// Nothing is left of a pivot of G G^T below this part of its greatest diagonal entry that could be
/// trusted as an inverse: then eigenvalues tell what is felt at all.
constexpr double safe_pivot = 1e-6;
/// An eigenvalue of G G^T below this part of the greatest is 0 but for rounding.
constexpr double unfelt_eigenvalue = 1e-14;

template <class Matrix, class Twist>
Matrix pseudo_inverse(const Matrix& GGt, std::vector<Twist>& kernel) {
  Matrix inverse = GGt;
  if (dual::invert(inverse, safe_pivot * GGt.diagonal().maxCoeff())) return inverse;
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(GGt);
  auto values = eigen.eigenvalues().eval();
  const double least = unfelt_eigenvalue * values.maxCoeff();
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    if (!(values[k] > least)) kernel.push_back(eigen.eigenvectors().col(k));
    values[k] = values[k] > least ? 1 / values[k] : 0;
  }
  return eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
}

InternalForce internal_force(const ContactLane<2>& c) {
  InternalForce force{};
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t other = 1 - i;
    const double x = (c.jy[other] - c.jy[i]) / c.share[i], z = (c.jx[i] - c.jx[other]) / c.share[i];
    const double n = c.nx[i] * x + c.ny[i] * z, t = c.nx[i] * z - c.ny[i] * x;
    for (std::size_t side = 0; side < 2; ++side) {
      const double rate = c.mu[i] * n + (side == 0 ? -t : t);
      force.per_margin[side][i] = rate != 0 ? 1 / rate : 0;
    }
    force.square += n * n + t * t;
  }
  return force;
}

/// Element k of a lane from a contact whose place in the hand is r, in radii.
void put(const Contact<2>& contact, const Vector<2>& r, double root, ContactLane<2>& lane,
         std::size_t k) {
  lane.nx[k] = root * contact.normal.x();
  lane.ny[k] = root * contact.normal.y();
  lane.jx[k] = -r.y();
  lane.jy[k] = r.x();
}
void put(const Contact<3>& contact, const Vector<3>& r, double root, ContactLane<3>& lane,
         std::size_t k) {
  const Eigen::Matrix<double, 3, 2> tangent = tangents(contact.normal);
  for (int d = 0; d < 3; ++d) {
    lane.n[d][k] = root * contact.normal[d];
    lane.a[d][k] = root * tangent(d, 0);
    lane.b[d][k] = root * tangent(d, 1);
    lane.r[d][k] = r[d];
  }
}

}  // namespace

template <int Dim>
Hand<Dim>::Scaled::Scaled(const std::vector<Contact<Dim>>& contacts, const Vector<Dim>& about,
                          double greatest_distance)
    : size(contacts.size()),
      lanes((size + lane_size - 1) / lane_size),
      center(about),
      radius(greatest_distance),
      length(radius > 0 ? radius : 1),
      per_length(1 / length) {
  std::fill(lanes.begin(), lanes.end(), ContactLane<Dim>{});
  for (std::size_t i = 0; i < size; ++i) {
    const Contact<Dim>& contact = contacts[i];
    ContactLane<Dim>& lane = lanes[i / lane_size];
    const std::size_t k = i % lane_size;
    const double root = std::sqrt(contact.share);
    put(contact, (contact.position - center) / length, root, lane, k);
    if constexpr (Dim == 3)
      lane.soft[k] = contact.torsion > 0 ? contact.torsion / (contact.friction * length) : 0;
    lane.share[k] = contact.share;
    lane.root[k] = root;
    lane.mu[k] = contact.friction;
    lane.edge[k] = 1 / (1 + contact.friction * contact.friction);
    lane.lo[k] = contact.min_normal / root;
    lane.hi[k] = contact.max_normal / root;
    limited = limited || contact.min_normal > 0 || std::isfinite(contact.max_normal);
  }
  prepare();
  for (const Contact<Dim>& contact : contacts)
    if (contact.pad) unfelt.clear();  // pads feel all
}

template <int Dim>
Hand<Dim>::Driven::Driven(const Hand<Dim>& hand)
    : drive_of((hand.contacts().size() + lane_size - 1) / lane_size * lane_size),
      lanes(hand.scaled().lanes.size()) {
  const Mechanism<Dim>& mechanism = hand.mechanism();
  const std::vector<std::string>& names = hand.fingers();
  const std::size_t fingers = names.size();
  if (mechanism.kind == DriveKind::listed) {
    drives.resize(mechanism.drives.size());
    for (std::size_t a = 0; a < drives.size(); ++a) {
      const Drive<Dim>& drive = mechanism.drives[a];
      drives[a] = {drive.max, drive.turns};
      for (const auto& moves : drive.moves) {
        const auto finger = std::find(names.begin(), names.end(), moves.finger);
        moved.push_back({a, static_cast<std::size_t>(finger - names.begin()), moves.twist});
      }
    }
  } else {
    const bool coupled = mechanism.kind == DriveKind::coupled;
    drives.resize(coupled ? 1 : fingers);
    std::fill(drives.begin(), drives.end(), Limit{std::numeric_limits<double>::infinity(), false});
    moved.reserve(fingers);
    for (std::size_t k = 0; k < fingers; ++k) {
      const Vector<Dim> direction = hand.closing(k);
      closing = closing && !direction.isZero(0);
      Moved moves{coupled ? 0 : k, k, Twist<Dim>::Zero()};
      moves.twist.template head<Dim>() = direction / (coupled ? static_cast<double>(fingers) : 1);
      moved.push_back(moves);
      for (const Finger<Dim>& given : mechanism.fingers)
        if (given.name == names[k])
          drives[moves.drive].max = std::min(drives[moves.drive].max, given.max_force);
    }
  }
  for (const Limit& drive : drives) {
    alike = alike && drive.turns == drives[0].turns && drive.max == drives[0].max;
    all_limited = all_limited && std::isfinite(drive.max);
  }

  SmallVector<const Moved*, 16> by(fingers);
  std::fill(by.begin(), by.end(), nullptr);
  for (const Moved& moves : moved) {
    apart = apart && by[moves.finger] == nullptr;
    by[moves.finger] = &moves;
  }
  for (const Contact<Dim>& contact : hand.contacts()) apart = apart && !contact.pad;
  std::fill(lanes.begin(), lanes.end(), DriveLane<Dim>{});
  std::fill(drive_of.begin(), drive_of.end(), drives.size());
  const Scaled& scaled = hand.scaled();
  const Cones<Dim> cones = scaled.cones(1);
  for (std::size_t i = 0; i < hand.contacts().size(); ++i) {
    const Moved* moves = by[hand.finger_of(i)];
    if (moves == nullptr) continue;
    drive_of[i] = moves->drive;
    const Limit& drive = drives[moves->drive];
    const double scale = !alike ? 1 / drive.max : drive.turns ? scaled.per_length : 1;
    const auto zeta =
        (dual::columns(cones, i).transpose() * (scale * about_center(scaled, 1, moves->twist)))
            .eval();
    for (int k = 0; k < contact_size<Dim>; ++k)
      lanes[i / lane_size].zeta[k][i % lane_size] = zeta[k];
  }
}

template <>
void Hand<2>::Scaled::prepare() {
  Eigen::Matrix3d GGt = Eigen::Matrix3d::Zero();
  for (const ContactLane<2>& lane : lanes) {
    const Lane sx = lane.share * lane.jx, sy = lane.share * lane.jy;
    GGt(0, 0) += sum(lane.share);
    GGt(2, 0) += sum(sx);
    GGt(2, 1) += sum(sy);
    GGt(2, 2) += sum(sx * lane.jx + sy * lane.jy);
  }
  GGt(1, 1) = GGt(0, 0);
  GGt(0, 2) = GGt(2, 0);
  GGt(1, 2) = GGt(2, 1);
  unfelt.clear();
  inverse = pseudo_inverse(GGt, unfelt);
  if (size == 2) internal = internal_force(lanes[0]);
}

template <>
void Hand<3>::Scaled::prepare() {
  // Where every contact presses and none slides, the dual function's curvature is G G^T.
  dual::Point<3> pressing(size);
  for (dual::LaneForces<3, double>& lane : pressing.lanes) {
    lane = dual::LaneForces<3, double>{};
    lane.f[0] += 1;
  }
  Cones<3> unlimited = cones(1);
  unlimited.limited = false;
  Eigen::Matrix<double, 6, 6> GGt = dual::curvature<3, double>(unlimited, pressing);
  GGt.triangularView<Eigen::StrictlyLower>() = GGt.transpose();
  unfelt.clear();
  inverse = pseudo_inverse(GGt, unfelt);
  // A very soft finger takes digits from the others in G G^T, not in G.
  for (Twist<3>& y : unfelt) {
    Twist<3> felt = Twist<3>::Zero();
    for (std::size_t i = 0; i < size; ++i) {
      const Eigen::Matrix<double, 6, 4> G = dual::columns(cones(1), i);
      felt += G * (G.transpose() * y);
    }
    y = (y - inverse * felt).normalized();
  }
}

template <int Dim>
typename Hand<Dim>::Scaled Hand<Dim>::Scaled::with_friction(double factor) const {
  Scaled changed = *this;
  for (ContactLane<Dim>& lane : changed.lanes) {
    lane.mu *= factor;
    lane.edge = 1 / (1 + lane.mu * lane.mu);
    if constexpr (Dim == 3)
      if (factor == 0) lane.soft *= 0;
  }
  changed.prepare();
  return changed;
}

template <int Dim>
typename Hand<Dim>::Scaled Hand<Dim>::Scaled::without_limits() const {
  Scaled changed = *this;
  changed.limited = false;
  for (std::size_t i = 0; i < size; ++i) {
    ContactLane<Dim>& lane = changed.lanes[i / lane_size];
    double hi = lane.hi[i % lane_size];
    if (std::isfinite(hi)) {
      hi = 0;
      changed.limited = true;
    }
    lane.lo[i % lane_size] = 0;
    lane.hi[i % lane_size] = hi;
  }
  return changed;
}

template <int Dim>
typename Hand<Dim>::Scaled Hand<Dim>::Scaled::without_max_normal() const {
  Scaled changed = *this;
  changed.limited = false;
  for (ContactLane<Dim>& lane : changed.lanes) {
    lane.hi = std::numeric_limits<double>::infinity() - Lane{};
    changed.limited = changed.limited || sum(lane.lo) > 0;
  }
  return changed;
}

template <>
Widened<2>::Widened(const Cones<2>& cones) : limited(cones.limited), lanes(cones.size) {
  for (std::size_t i = 0; i < cones.size; ++i) {
    const ContactLane<2>& c = cones.lanes[i / lane_size];
    const std::size_t k = i % lane_size;
    ContactLane<2, Wide>& w = lanes[i];
    w = {c.nx[k], c.ny[k], c.jx[k], c.jy[k], 0, 0, c.mu[k], 0, 0, 0};
    w.share = w.nx * w.nx + w.ny * w.ny;
    w.edge = 1 / (1 + w.mu * w.mu);
    w.lo = c.lo[k] * cones.per_weight;
    w.hi = c.hi[k] * cones.per_weight;
  }
}

template <>
Widened<3>::Widened(const Cones<3>& cones) : limited(cones.limited), lanes(cones.size) {
  for (std::size_t i = 0; i < cones.size; ++i) {
    const ContactLane<3>& c = cones.lanes[i / lane_size];
    const std::size_t k = i % lane_size;
    ContactLane<3, Wide>& w = lanes[i];
    // The tangents are perpendicular to the normal in all digits.
    Eigen::Matrix<Wide, 3, 1> n, a;
    for (int d = 0; d < 3; ++d) {
      n[d] = c.n[d][k];
      a[d] = c.a[d][k];
      w.r[d] = c.r[d][k];
    }
    w.share = n.squaredNorm();
    if (w.share > 0) {
      a -= n * (a.dot(n) / w.share);
      a *= sqrt(w.share / a.squaredNorm());
    }
    const Eigen::Matrix<Wide, 3, 1> b = n.cross(a) / (w.share > 0 ? sqrt(w.share) : Wide(1));
    for (int d = 0; d < 3; ++d) {
      w.n[d] = n[d];
      w.a[d] = a[d];
      w.b[d] = b[d];
    }
    w.root = 0;
    w.soft = c.soft[k];
    w.mu = c.mu[k];
    w.edge = 1 / (1 + w.mu * w.mu);
    w.lo = c.lo[k] * cones.per_weight;
    w.hi = c.hi[k] * cones.per_weight;
  }
}

template struct Hand<2>::Scaled;
template struct Hand<3>::Scaled;
template struct Hand<2>::Driven;
template struct Hand<3>::Driven;

}  // namespace poise
