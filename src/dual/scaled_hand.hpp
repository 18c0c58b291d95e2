// The hand as the solver sees it. Not installed.
#pragma once

#include <vector>

#include "dual/contact_lane.hpp"
#include "poise/grasp.hpp"
#include "poise/small_vector.hpp"

namespace poise {

/// Of two contacts.
using Pair = double __attribute__((vector_size(16)));

/// Two contacts in the plane have one internal force, along the line between them: how far it goes
/// until mu n - t (first) or mu n + t of a contact vanishes.
struct InternalForce {
  Pair per_margin[2];  ///< 1 / the rate at which it grows; 0 where it stays
  double square;       ///< of its length
};

template <int Dim>
struct Hand<Dim>::Scaled {
  Scaled(const std::vector<Contact<Dim>>& contacts, const Vector<Dim>& center, double radius);

  /// The contacts in a unit of force [N].
  Cones<Dim> cones(double weight) const {
    return {size, limited, 1 / weight, {lanes.data(), lanes.size()}};
  }
  /// The same hand with all frictions and torsions multiplied by a factor >= 0.
  Scaled with_friction(double factor) const;
  /// The contacts without max_normal alone, the others made to press with nothing, none with a
  /// min_normal: what these can hold once they can hold at any size.
  Scaled without_limits() const;
  Scaled without_max_normal() const;

  std::size_t size;
  bool limited{false};
  SmallVector<ContactLane<Dim>, 16 / lane_size> lanes;
  Vector<Dim> center;
  double radius;      ///< L [m]; may be 0
  double length;      ///< L [m], or 1 where every contact is at the center
  double per_length;  ///< 1 / length [1/m]
  /// Pseudo-inverse of G G^T: the dual of a load while no contact is at the border of its cone.
  Eigen::Matrix<double, wrench_size<Dim>, wrench_size<Dim>> inverse;
  InternalForce internal{};  ///< of two contacts in the plane
  /// Twists that no contact feels, an orthonormal basis: two hard fingers leave one in space.
  /// There a frictionless contact feels what moves it along its normal alone.
  std::vector<Twist<Dim>> unfelt;

 private:
  void prepare();  ///< what follows from the lanes: inverse, internal, unfelt
};

template <int Dim>
using ScaledHand = typename Hand<Dim>::Scaled;

/// What the contacts of a lane feel of their drive at speed 1, as z in the solver's units; of a
/// drive that turns per radius L, and where grip is in parts of max per newton of max.
template <int Dim>
struct alignas(sizeof(Lane)) DriveLane {
  Lane zeta[contact_size<Dim>];
};

template <int Dim>
struct Hand<Dim>::Driven {
  explicit Driven(const Hand<Dim>& hand);

  /// A finger that a drive moves.
  struct Moved {
    std::size_t drive, finger;
    Twist<Dim> twist;  ///< per unit of the drive's speed, about the object frame's origin
  };
  struct Limit {
    double max;
    bool turns;
  };
  std::vector<Moved> moved;  ///< drive by drive
  SmallVector<Limit, 8> drives;
  bool closing{true};      ///< whether every finger that a drive closes has a closing direction
  bool alike{true};        ///< whether efforts are compared as they are
  bool all_limited{true};  ///< whether every drive has a max

  // As the solver sees it, where no finger is moved by two drives.
  bool apart{true};
  SmallVector<std::size_t, 16> drive_of;  ///< of each contact, or their number; lanes are filled up
  SmallVector<DriveLane<Dim>, 16 / lane_size> lanes;

  bool has_grip() const { return closing && (alike || all_limited); }
};

template <int Dim>
using Driven = typename Hand<Dim>::Driven;

/// The same contacts in wider numbers, with limits in the unit of force.
template <int Dim>
struct Widened {
  explicit Widened(const Cones<Dim>& cones);
  Cones<Dim, Wide> cones() const {
    return {lanes.size(), limited, 1, {lanes.data(), lanes.size()}};
  }

  bool limited;
  SmallVector<ContactLane<Dim, Wide>, 16> lanes;
};

}  // namespace poise
