#include "plane/grip_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dual/grip_program.hpp"
#include "dual/twist.hpp"
#include "hold/cone_hand.hpp"
#include "plane/arc.hpp"
#include "plane/cover.hpp"

namespace poise {
namespace {

using dual::Affine;
using std::numbers::pi;

Harmonic1 harmonic(const Affine& g, double unit) { return {unit * g[0], unit * g[1], unit * g[2]}; }

class GripTracer {
 public:
  GripTracer(const Grasp<2>& grasp, const CurveSettings& settings, PostureCurve& curve)
      : hand_(grasp.scaled()),
        weight_(grasp.size()),
        unit_(scaled_grip<2>(grasp, weight_)),
        most_(most_grip<2>(grasp) / unit_),
        cap_(settings.force_cap),
        cones_(cone_hand<2>(grasp, weight_, dual::Wanted::grip)),
        program_(cones_, load_curve(hand_, weight_, grasp.loads().front())),
        contacts_(grasp.contacts()),
        drives_(grasp.drives()),
        in_parts_(grip_unit<2>(grasp) == GripUnit::part_of_max),
        curve_(curve) {}

  void trace(const Interval& holdable) {
    const auto piece = [&](double at, double lo, double hi) { return piece_at(at, lo, hi); };
    if (holdable.to - holdable.from < 2 * pi) {
      cover(holdable.from, holdable.to, contacts_.size(), piece);
    } else {
      cover_circle(contacts_.size(), piece);
    }
  }

 private:
  Interval piece_at(double at, double lo, double hi) {
    const std::optional<dual::GripPiece> found = program_.at(at);
    if (!found) return {at, at};
    Reach reach(at);
    for (const Affine& g : found->conditions) reach.keep(g, found->rounding);
    Affine left = -found->F;
    left[0] += most_;
    const double here = left[0] + left[1] * reach.cosine + left[2] * reach.sine;
    const bool held = here >= -1e-9 * most_;
    if (std::isfinite(most_)) reach.keep(held ? left : Affine(-left), 1e-12 * most_);
    const Interval piece{std::max(lo, reach.from()), std::min(hi, reach.to())};
    if (!(piece.to > piece.from)) return {at, at};
    held ? add_arc(*found, piece) : add_unholdable(*found, piece);
    return piece;
  }

  /// About the object frame's origin, per unit of the grip.
  Twist<2> told(const Twist<2>& y) const { return about_origin(hand_, unit_ / weight_, y); }

  void add_arc(const dual::GripPiece& found, const Interval& piece) {
    Arc& arc = curve_.arcs.emplace_back();
    arc.from = piece.from;
    arc.to = piece.to;
    const Harmonic1 F = harmonic(found.F, unit_);
    arc.value = {F.c0, F.cos1, F.sin1, 0, 0};
    // Rounding leaves no contact that a drive closes any power.
    const dual::GripCut<2> cut = dual::grip_cut(cones_, {.y = found.y, .rates = found.rates}, cap_);
    arc.rates = cut.rates;
    const double sum = std::max(cut.rate_sum, 1.0);
    for (double& rate : *arc.rates) rate /= sum;
    const Twist<2> y = told(cut.y / sum);
    for (std::size_t k = 0; k < 3; ++k) arc.y[k].c0 = y[static_cast<Eigen::Index>(k)];
    arc.first_state = curve_.states.size();
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const Affine &n = found.normals[i], &t = found.tangentials[i];
      arc.forces.push_back({harmonic(n, weight_), harmonic(t, weight_)});
      curve_.states.push_back(state(contacts_[i], n, t));
    }
  }

  ArcState state(const Contact<2>& contact, const Affine& n, const Affine& t) const {
    const auto vanishes = [](const Affine& g) { return g.cwiseAbs().maxCoeff() <= 1e-9; };
    const auto at = [&](double limit) {
      return std::isfinite(limit) && vanishes(n - Affine(limit / weight_, 0, 0));
    };
    const Affine most = contact.friction * n;
    return {vanishes(n)                                ? ContactState::unloaded
            : vanishes(most - t) || vanishes(most + t) ? ContactState::slipping
                                                       : ContactState::sticking,
            at(contact.max_normal)                             ? ForceLimit::max
            : contact.min_normal > 0 && at(contact.min_normal) ? ForceLimit::min
                                                               : ForceLimit::none};
  }

  /// Where F is above the drives' max, (y, rates) prove an effort above any cap, made long.
  void add_unholdable(const dual::GripPiece& found, const Interval& piece) {
    const double longer = 1e6 * cap_ * cap_;
    UnholdableArc gap{piece.from, piece.to, longer * about_origin(hand_, weight_, found.y), {}};
    // Of the grip they are per part of max, of the effort per unit of a drive's speed.
    gap.rates = found.rates;
    for (std::size_t a = 0; a < drives_.size(); ++a)
      (*gap.rates)[a] *= longer * weight_ * weight_ / (in_parts_ ? drives_[a].max : unit_);
    curve_.unholdable_arcs.push_back(std::move(gap));
  }

  const ScaledHand<2>& hand_;
  double weight_, unit_, most_, cap_;
  dual::ConeHand<2> cones_;
  dual::GripProgram program_;
  const std::vector<Contact<2>>& contacts_;
  std::vector<Drive<2>> drives_;
  bool in_parts_;
  PostureCurve& curve_;
};

}  // namespace

void trace_grip(const Grasp<2>& grasp, const CurveSettings& settings, PostureCurve& curve) {
  curve.arcs.clear();
  curve.states.clear();
  GripTracer tracer(grasp, settings, curve);
  for (const Interval& holdable : curve.holdable)
    if (holdable.from != holdable.to) tracer.trace(holdable);
}

}  // namespace poise
