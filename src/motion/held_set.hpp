// The wrenches that a hand holds within its limits, a convex set, told from both sides. Not
// installed.
#pragma once

#include <optional>

#include "poise/hold.hpp"

namespace poise {

/// y . w <= most for every wrench w that is held.
struct HeldRow {
  Twist<3> y = Twist<3>::Zero();
  SmallVector<double, 4> rates;  ///< of the drives, per newton or newton metre; empty: 0
  double most{0};
};

/// What a hand holds by forces within the limits of contacts and drives, whose norm is at most a
/// cap. Remembers where it was asked last, to start there.
class HeldSet {
 public:
  /// @param weight  [N]: the unit of the force cap
  HeldSet(const Hand<3>& hand, double weight, double force_cap);

  /// How large a wrench is [N]: |force| + |moment about the hand's center| / length.
  double size(const Wrench<3>& w) const;

  /// Whether w is held, for certain.
  bool holds(const Wrench<3>& w);
  /// What tells a wrench that was just found not to be held from all that are; none where rounding
  /// leaves it open.
  std::optional<HeldRow> row(const Wrench<3>& w) const;

 private:
  HeldRow row_of(const Twist<3>& y, const SmallVector<double, 4>& rates) const;
  double most(const Twist<3>& y, const SmallVector<double, 4>& rates) const;
  SmallVector<double, 4> eased(const Twist<3>& y, const SmallVector<double, 4>& rates) const;

  const Hand<3>& hand_;
  double weight_, cap_;  ///< [N]
  bool limited_drives_{false}, limited_{false};
  Objective objective_{Objective::effort};
  Hold<3> hold_;
  Twist<3> start_ = Twist<3>::Zero();
};

/// Of the points from + t (to - from), 0 <= t <= 1, those that are held: an interval, whose end is
/// told from both sides.
struct RayEnd {
  bool found{false};  ///< whether any is held; else none was found, or floor > bound
  double held{0};     ///< is held
  double bound{1};    ///< nothing beyond is held, by `row`; 1 without it
  double floor{0};    ///< nothing before is held
  std::optional<HeldRow> row;
};
/// @param gap  wanted: (bound - held) / bound
RayEnd ray_end(HeldSet& set, const Wrench<3>& from, const Wrench<3>& to, double gap);

}  // namespace poise
