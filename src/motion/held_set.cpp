#include "motion/held_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dual/exact.hpp"
#include "hold/cone_hand.hpp"
#include "poise/grip.hpp"

namespace poise {
namespace {

using Real = dual::Exact;
using dual::Rates;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double rounding = 4e-16;  // of a twist
constexpr int most_probes = 100;

}  // namespace

HeldSet::HeldSet(const Hand<3>& hand, double weight, double force_cap)
    : hand_(hand), weight_(weight), cap_(force_cap * weight) {
  if (!(force_cap > 0) || !(force_cap <= 1e9))
    throw InvalidGrasp("force_cap", "must be above 0 and at most 1e9 weights");
  for (const auto& drive : hand.driven().drives)
    limited_drives_ = limited_drives_ || std::isfinite(drive.max);
  limited_ = limited_drives_;
  for (const Contact<3>& contact : hand.contacts())
    limited_ = limited_ || std::isfinite(contact.max_normal);
  if (limited_drives_ && has_grip(hand)) objective_ = Objective::grip;
}

double HeldSet::size(const Wrench<3>& w) const {
  const Vector<3> force = w.head<3>();
  return force.norm() + (w - wrench_of<3>(force, hand_.center())).norm() / hand_.length();
}

bool HeldSet::holds(const Wrench<3>& w) {
  const double unit = weight_ + size(w);
  hold_ = hold<3>(hand_, w, unit, start_, {std::min(cap_ / unit, 1e9), objective_});
  if (hold_.holdable) start_ = hold_.dual;
  return hold_.holdable;
}

/// Capacity has the same for weights: what contacts and drives can do against (y, rates) at most.
double HeldSet::most(const Twist<3>& y, const Rates& rates) const {
  Real fixed = 0, squared = 0;
  const auto& drives = hand_.driven().drives;
  for (std::size_t a = 0; a < rates.size(); ++a)
    if (rates[a] > 0) fixed += Real{rates[a]} * drives[a].max;
  const auto felt = dual::against_fingers(hand_, y, rates, false);
  for (std::size_t i = 0; i < hand_.contacts().size(); ++i) {
    const Contact<3>& contact = hand_.contacts()[i];
    const Twist<3>& z = felt[hand_.finger_of(i)];
    const Real along = dual::power(contact, z);
    if (std::isfinite(contact.max_normal)) {
      fixed += (along > 0 ? contact.max_normal : contact.min_normal) * along;
      continue;
    }
    fixed += contact.min_normal * along;
    if (along <= 0) continue;
    Contact<3> whole = contact;
    whole.min_normal = 0;
    squared += 2 * std::max(dual::phi(whole, z, 1), Real{0});
  }
  return static_cast<double>(fixed + cap_ * std::sqrt(squared));
}

/// Rates at which contacts without max_normal can do nothing.
Rates HeldSet::eased(const Twist<3>& y, const Rates& rates) const {
  const Driven<3>& driven = hand_.driven();
  Rates more(driven.drives.size());
  for (std::size_t a = 0; a < more.size(); ++a) more[a] = rates.empty() ? 0 : rates[a];
  for (std::size_t i = 0; i < hand_.contacts().size(); ++i) {
    const Contact<3>& contact = hand_.contacts()[i];
    if (std::isfinite(contact.max_normal)) continue;
    const Twist<3> z = dual::against_fingers(hand_, y, more, false)[hand_.finger_of(i)];
    const double along = static_cast<double>(dual::power(contact, z)) +
                         rounding * (z.cwiseAbs().sum() + y.cwiseAbs().sum());
    if (!(along > 0)) continue;
    double least = infinity, step = 0;
    std::size_t best = 0;
    for (const auto& moved : driven.moved) {
      if (moved.finger != hand_.finger_of(i)) continue;
      const double eases = -static_cast<double>(dual::power(contact, Twist<3>(-moved.twist)));
      const double max = driven.drives[moved.drive].max;
      if (!(eases > 0) || !(max / eases < least)) continue;
      least = max / eases;
      step = along / eases;
      best = moved.drive;
    }
    if (least < infinity) more[best] += step;
  }
  return more;
}

HeldRow HeldSet::row_of(const Twist<3>& y, const Rates& rates) const {
  HeldRow row{y, rates, most(y, rates)};
  if (!limited_drives_) return row;
  Rates more = eased(y, rates);
  if (const double by_more = most(y, more); by_more < row.most) row = {y, std::move(more), by_more};
  return row;
}

std::optional<HeldRow> HeldSet::row(const Wrench<3>& w) const {
  std::optional<HeldRow> best;
  double violated = 0;
  const auto add = [&](Twist<3> y, Rates rates) {
    const double length = y.head<3>().norm() + y.tail<3>().norm() * hand_.length();
    if (!(length > 0) || !std::isfinite(length)) return;
    y /= length;
    for (double& rate : rates) rate /= length;
    HeldRow row = row_of(y, rates);
    const double by = y.dot(w) - row.most;
    if (!(by > violated)) return;
    violated = by;
    best = std::move(row);
  };
  Rates rates = hold_.rates;
  if (hold_.objective == Objective::grip && grip_unit(hand_) == GripUnit::part_of_max)
    for (std::size_t a = 0; a < rates.size(); ++a) rates[a] /= hand_.driven().drives[a].max;
  add(hold_.dual, std::move(rates));
  if (limited_ && objective_ == Objective::effort) {
    const LeastPart<3> part = least_part(hand_, 1, w, weight_ + size(w));
    add(part.y, part.rates);
  }
  return best;
}

RayEnd ray_end(HeldSet& set, const Wrench<3>& from, const Wrench<3>& to, double gap) {
  RayEnd end;
  const Wrench<3> way = to - from;
  double failed = infinity, step = gap / 4, probe = 1;
  for (int k = 0; k < most_probes; ++k) {
    const Wrench<3> w = from + probe * way;
    if (set.holds(w)) {
      end.found = true;
      end.held = probe;
    } else {
      failed = probe;
      if (std::optional<HeldRow> row = set.row(w)) {
        const double slope = row->y.dot(way), at = (row->most - row->y.dot(from)) / slope;
        if (slope > 0 && at < end.bound) {
          end.bound = at;
          end.row = std::move(row);
        } else if (slope < 0) {
          end.floor = std::max(end.floor, std::min(at, 1.0));
        } else if (slope == 0) {
          return end;
        }
      }
    }
    const double top = std::min(end.bound, failed);
    if (end.found && (end.bound - end.held <= gap * end.bound || top - end.held <= gap / 8 * top ||
                      end.held >= 1))
      return end;
    if (!(end.bound >= 0) || end.floor > end.bound) return end;
    if (!end.found && end.floor > 0) {  // only from some length on
      if (!(top - end.floor > gap / 8 * top)) return end;
      probe = end.floor + (top - end.floor) * (failed < end.bound ? 0.5 : 1 - step);
    } else if (end.found) {
      probe = std::max(end.held + (top - end.held) / 2, std::min(end.bound * (1 - gap / 4), top));
      if (!(probe < top)) probe = end.held + (top - end.held) / 2;
    } else {
      if (!(end.bound * (1 - gap / 4) < failed)) step = std::min(8 * step, 0.5);
      probe = top * (1 - step);
    }
  }
  return end;
}

}  // namespace poise
