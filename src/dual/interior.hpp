// The interior-point method, for what has more unknowns than a twist: the least grip, and holds
// under limits of drives or with pads. docs/theory.md, "The least grip". Not installed.
//
//   grip:    minimise F             subject to  Σ G f = w,  f in the cones,  e_a <= F for all
//   drives effort:  minimise Σ |f|²/2      subject to  Σ G f = w,  f in the cones,  e_a <= max_a
//
// with e_a = Σ over fingers of (twist of the finger) . (wrench of its contacts). A contact is a
// normal force N with tangential parts, each |t_k| <= reach_k N: for a point one, with the moment
// of a soft finger; for a pad one of each of its points, and one for either way in which the centre
// of pressure moves. So the equations of a contact have the shape of an arrow: each is eliminated
// by itself, and (y, rates) are left, with F.
//
// The homogeneous embedding ends with forces and (y, rates), or with a y that proves that there are
// no forces; scaled after Nesterov and Todd, steps after Mehrotra. E. D. Andersen, C. Roos,
// T. Terlaky, On implementing a primal-dual interior-point method for conic quadratic optimization,
// Mathematical Programming 95 (2003) 249-277.
#pragma once

#include <vector>

#include "poise/wrench.hpp"

namespace poise::dual {

/// The most components of a part: in space two tangential and the moment about the normal.
template <int Dim>
inline constexpr int part_size = Dim == 2 ? 1 : 3;
template <int Dim>
using PartForce = Eigen::Matrix<double, part_size<Dim>, 1>;

/// A tangential part of a contact: |t| <= reach N.
template <int Dim>
struct ConePart {
  double reach;   ///< > 0
  double weight;  ///< of |t|^2 in the effort
  /// Wrenches of the components; columns of zeros for those that it does not have.
  Eigen::Matrix<double, wrench_size<Dim>, part_size<Dim>> G;
};

/// A contact with the parts [first, last).
template <int Dim>
struct ConeContact {
  Wrench<Dim> normal;  ///< of N = 1
  double weight;       ///< of N^2 in the effort
  double lo, hi;       ///< limits of N
  std::size_t first, last;
  std::size_t finger;
};

template <int Dim>
struct ConeDrive {
  struct Moved {
    std::size_t finger;
    Twist<Dim> twist;  ///< of the finger per unit of the drive's speed
  };
  std::vector<Moved> moved;
  double max;  ///< of the effort; nothing to the grip
};

/// A hand in any units, moments about any point.
template <int Dim>
struct ConeHand {
  std::size_t fingers;
  std::vector<ConeContact<Dim>> contacts;
  std::vector<ConePart<Dim>> parts;
  std::vector<ConeDrive<Dim>> drives;
};

enum class Wanted { grip, effort };

template <int Dim>
struct Balance {
  enum class State {
    held,      ///< forces, and (y, rates) that prove their value
    not_held,  ///< y proves that there are no forces
    open,      ///< neither to all digits
  };
  State state;
  double error;                             ///< of balance, rates and value, in parts: the largest
  double value;                             ///< F, or Σ |f|²/2
  Wrench<Dim> residual;                     ///< w - Σ G f
  std::vector<double> normals;              ///< N of each contact
  std::vector<PartForce<Dim>> tangentials;  ///< t of each part
  Twist<Dim> y;
  std::vector<double> rates;  ///< of the drives, >= 0; to the grip their sum is at most 1
  int steps;
};

template <int Dim>
Balance<Dim> balance(const ConeHand<Dim>& hand, const Wrench<Dim>& w, Wanted wanted);
/// As far as doubles come.
template <int Dim>
Balance<Dim> quick_balance(const ConeHand<Dim>& hand, const Wrench<Dim>& w, Wanted wanted);

/// What (y, rates) prove of the grip: rate_sum F >= y . w - fixed, for every w. (10) of
/// docs/theory.md.
template <int Dim>
struct GripCut {
  Twist<Dim> y;
  std::vector<double> rates;  ///< >= 0
  double rate_sum;
  double fixed;  ///< what contacts with limits can do
};
/// That of what was found, with the rates raised where rounding left a contact without a limit
/// some power: then it proves what it says, to the last digit. `force_norm`: where no rates help,
/// of the forces that are looked at.
template <int Dim>
GripCut<Dim> grip_cut(const ConeHand<Dim>& hand, const Balance<Dim>& found, double force_norm);

}  // namespace poise::dual
