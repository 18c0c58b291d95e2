// What contacts can supply to one load: the accelerations z of the com, against gravity and with
// whatever the object undergoes, for which forces within the limits exist. Not installed.
//
//   w(z) = (W / g) z through the com + still
//
// z = (g + lift) up for the load as it is. The set is convex and knows nothing of the posture:
// docs/theory.md, "Shake".
#pragma once

#include <optional>
#include <vector>

#include "hold/cone_hand.hpp"
#include "poise/shake.hpp"

namespace poise {

/// All that is supplied has n . z <= b, by (y, rates) about the object frame's origin.
template <int Dim>
struct SupplyCut {
  Vector<Dim> n = Vector<Dim>::Zero();  ///< of length 1; zero where z has no power against y
  double b{0};                          ///< [m/s^2]
  Twist<Dim> y = Twist<Dim>::Zero();
  SmallVector<double, 4> rates;
};

template <int Dim>
class Supply {
 public:
  struct Answer {
    /// The greatest part of the limits that is used at least; infinite where friction refuses, or
    /// nothing was found. Held up to 1.
    double part;
    std::optional<SupplyCut<Dim>> cut;
  };

  /// @param load  with a weight; a load without one asks about its fixed wrench, whatever z is
  Supply(const Hand<Dim>& hand, const Load<Dim>& load, double force_cap);

  Answer ask(const Vector<Dim>& z) const;
  /// Of the load in a posture.
  Vector<Dim> at(const Vector<Dim>& up) const { return gravity() * up; }
  double gravity() const { return standard_gravity + load_.lift; }
  /// Whether forces can be multiplied: then parts are proportional to z.
  bool is_gauge() const { return is_gauge_; }

 private:
  Wrench<Dim> wrench(const Vector<Dim>& z) const;
  SupplyCut<Dim> cut_by(const Twist<Dim>& y, SmallVector<double, 4> rates) const;
  Answer ask_limits(const Wrench<Dim>& w) const;
  Answer ask_hold(const Wrench<Dim>& w) const;

  const Hand<Dim>& hand_;
  const Load<Dim>& load_;
  double cap_, unit_;
  Wrench<Dim> still_;
  std::optional<PartHand<Dim>> parts_;  ///< where anything is limited
  std::vector<Drive<Dim>> drives_;
  bool is_gauge_{false};
};

}  // namespace poise
