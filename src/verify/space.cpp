#include "verify/space.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "verify/checks.hpp"
#include "verify/trig.hpp"

namespace poise::verify {
namespace {

/// How far `up` is from the direction of the tilt [rad].
Real tilted(const Tilt& tilt, const Vector<3>& up) {
  const Vec3 from = tilt.from.cast<Real>(), direction = up.cast<Real>();
  return std::atan2(from.cross(direction).norm(), from.dot(direction));
}

/// How far below its max_normal the contact that is nearest to it presses [N].
Real slack_below_limits(const RealGrasp& grasp, const HoldClaim<3>& hold) {
  Real slack = std::numeric_limits<Real>::infinity();
  for (std::size_t i = 0; i < hold.contacts.size(); ++i)
    slack = std::min(slack, grasp.contacts[i].most - hold.contacts[i].normal_force);
  return slack;
}

/// Whether a minimum is inside of the domain and of what can be held, for sure.
bool is_surely_inside(const RealGrasp& grasp, const std::optional<Tilt>& tilt,
                      const HoldClaim<3>& hold) {
  if (tilt && tilted(*tilt, hold.up) > tilt->most - 1e-5L) return false;
  if (!hold.holdable) return false;
  for (std::size_t k = 0; k < grasp.loads.size(); ++k) {
    const HoldClaim<3>* own = &hold;
    if (k != hold.load.value_or(0)) {
      if (k >= hold.load_holds.size() || !hold.load_holds[k]) return false;
      own = &*hold.load_holds[k];
    }
    if (own->contacts.size() != grasp.contacts.size() ||
        !holds_around(grasp, grasp.loads[k], slack_below_limits(grasp, *own)))
      return false;
  }
  return true;
}

void check_in_domain(Verdict& verdict, const Path& place, const RealGrasp& grasp,
                     const OptionsClaim& options, const HoldClaim<3>& hold) {
  check_least_hold(verdict, place, grasp, hold, options.force_cap);
  verdict.check(place / "objective", "objective is that of the options",
                hold.objective == options.objective);
  verdict.check(place, "an optimum is holdable", hold.holdable);
  if (options.tilt)
    verdict.check(place, "the posture lies in the domain [rad]",
                  tilted(*options.tilt, hold.up) - options.tilt->most, 1e-8L);
}

/// What is named first may need so much more, in parts: the present posture, or the least turn.
constexpr Real tie = 1e-6L;
constexpr Real rounding = 2e-8L;

void check_minima(Verdict& verdict, const RealGrasp& grasp, const BestDocument<3>& best) {
  const Path list = Path() / "minima";
  for (std::size_t k = 0; k < best.minima.size(); ++k)
    check_in_domain(verdict, list[k], grasp, best.options, best.minima[k]);
  for (std::size_t k = 1; k < best.minima.size(); ++k)
    verdict.check(list, "minima are in the order of what they need, but for a tie of the first",
                  (value(best.minima[k - 1]) - value(best.minima[k])) / value(best.minima[k]),
                  k == 1 ? tie : rounding);
  verdict.unchecked(list, "that they are all, and minima, and no two the same: each is a hold");
}

/// Checks that what belongs to a best posture is null.
void check_null(Verdict& verdict, const BestDocument<3>& best, const std::string& words) {
  verdict.check(Path() / "best_pinched", words, !best.best_pinched);
  verdict.check(Path() / "relative_gap", words, !best.relative_gap);
  verdict.check(Path() / "minima", words, best.minima.empty());
  verdict.check(Path() / "turn", words, !best.turn);
}

void check_pinched(Verdict& verdict, const RealGrasp& grasp, const BestDocument<3>& best) {
  const Path place = Path() / "best_pinched";
  const auto& pinched = best.best_pinched;
  verdict.unchecked(place, "whether it is inside of what can be held, and no other is lower");
  for (const HoldClaim<3>& minimum : best.minima)
    if (minimum.manner == Manner::pinched && is_surely_inside(grasp, best.options.tilt, minimum))
      verdict.check(place, "best_pinched is no higher than a pinched minimum inside the domain",
                    pinched ? value(*pinched) / value(minimum) : 2, 1 + tie);
  if (!pinched) return;
  check_in_domain(verdict, place, grasp, best.options, *pinched);
  verdict.check(place, "best_pinched is pinched", pinched->manner == Manner::pinched);
  verdict.check(place, "best_pinched is one of the minima",
                std::any_of(best.minima.begin(), best.minima.end(), [&](const auto& minimum) {
                  return (real(minimum.up) - real(pinched->up)).norm() <= 1e-9L;
                }));
}

/// Checks the best posture against the bound and the minima.
void check_best_hold(Verdict& verdict, const RealGrasp& grasp, const BestDocument<3>& best,
                     Real bound) {
  const Path place = Path() / "best", of_gap = Path() / "relative_gap";
  check_in_domain(verdict, place, grasp, best.options, *best.best);
  const Real effort = value(*best.best), gap = effort > 0 ? (effort - bound) / effort : 0;
  verdict.check(Path() / "lower_bound", "lower_bound is not above what the best needs", -gap,
                1e-9L);
  verdict.check(of_gap, "relative_gap is (value - lower_bound) / value",
                best.relative_gap ? std::abs(*best.relative_gap - std::max(Real{0}, gap)) : 1,
                1e-13L);
  if (best.status == Status::optimal)
    verdict.check(of_gap, "the gap is the wanted one", gap,
                  best.options.gap.value_or(SpatialSettings{}.gap) + 1e-9L);
  else
    verdict.check(Path() / "status", "status is gap only where the gap is not the wanted one",
                  best.options.gap.value_or(0) - gap, 1e-9L);
  const bool listed = !best.minima.empty();
  verdict.check(Path() / "minima", "the best is among the minima", listed);
  if (listed)
    verdict.check(place, "best is the first of the minima",
                  (real(best.best->up) - real(best.minima.front().up)).norm() +
                      difference(effort, value(best.minima.front())),
                  1e-9L);
}

}  // namespace

void check_best(Verdict& verdict, const RealGrasp& grasp, const BestDocument<3>& best) {
  check_options(verdict, grasp.dim, best.options, {"domain", "gap", "max_holds", "objective"},
                {"tilt", "orientation"});
  verdict.check(Path() / "minima_complete", "no list of minima in space is complete",
                !best.minima_complete);
  verdict.unchecked(Path() / "holds", "how many holds the proof took");
  check_minima(verdict, grasp, best);
  if (best.status == Status::unholdable) {
    verdict.check(Path() / "best", "is null where nothing is held", !best.best);
    verdict.check(Path() / "lower_bound", "is null where nothing is held", !best.lower_bound);
    check_null(verdict, best, "is null where nothing is held");
    return check_cuts(verdict, grasp, best.cuts, best.options, most_held(grasp, best.options),
                      "cuts prove that the force cap is not enough: they leave nothing on the "
                      "unit sphere");
  }
  verdict.check(Path() / "lower_bound", "there is a lower bound", best.lower_bound.has_value());
  const Real bound = best.lower_bound.value_or(0);
  if (bound > 0)
    check_cuts(verdict, grasp, best.cuts, best.options, bound,
               "cuts prove lower_bound: they leave nothing on the unit sphere");
  verdict.check(Path() / "best", "best is null only where the gap stays open",
                best.best || best.status == Status::gap);
  if (!best.best) {
    check_null(verdict, best, "is null where nothing was found");
    verdict.leave_open("Nothing was found that can be held, nor a proof that nothing can.");
    return;
  }
  check_best_hold(verdict, grasp, best, bound);
  check_pinched(verdict, grasp, best);
}

}  // namespace poise::verify
