#include <algorithm>

#include "verify/checks.hpp"
#include "verify/curve.hpp"

namespace poise::verify {
namespace {

/// Where two claims are about one posture, they must be the same.
void check_same(Verdict& verdict, const RealOptimum& a, const RealOptimum& b,
                const std::string& words) {
  verdict.check(a.place, words,
                difference(value(a.claim), value(b.claim)) + angle_between(a.angle, b.angle),
                1e-9L);
}

/// A curve, as far as it has been checked.
struct CheckedCurve {
  std::vector<RealArc> arcs;
  std::vector<Chain> chains;
};

/// @param claim  of a curve, and where it stands
template <class Claim>
CheckedCurve check_pieces(Verdict& verdict, const Path& place, const EachLoad& grasps,
                          const Claim& claim, const RealDomain& domain,
                          const OptionsClaim& options) {
  CheckedCurve curve{check_arcs(verdict, place / "arcs", grasps, claim.arcs, options), {}};
  curve.chains = check_tiling(verdict, place / "holdable_arcs_deg", curve.arcs,
                              claim.holdable_arcs_deg, domain);
  return curve;
}

/// Of several loads with the curves of each.
template <class Claim>
CheckedCurve check_pieces(Verdict& verdict, const EachLoad& grasps, const Claim& claim,
                          const RealDomain& domain) {
  CheckedCurve curve = check_pieces(verdict, {}, grasps, claim, domain, claim.options);
  const Path list = Path() / "load_curves";
  const auto& curves = claim.load_curves;
  const bool complete = grasps.size() == 1 ? !curves : curves && curves->size() == grasps.size();
  verdict.check(list, "the curve of each load is told where there are several", complete);
  if (grasps.size() == 1 || !complete) return curve;
  std::vector<std::vector<RealArc>> own;
  for (std::size_t k = 0; k < grasps.size(); ++k)
    own.push_back(
        check_pieces(verdict, list[k], {grasps[k]}, (*curves)[k], domain, claim.options).arcs);
  check_envelope(verdict, grasps, curve.arcs, own, claim.options);
  return curve;
}

RealDomain domain_of(const RealGrasp& grasp, const OptionsClaim& options) {
  return domain_of(grasp, options.domain.value_or(Domain::all));
}

/// Checks the first and the pinched one of the minima, and the worst posture.
void check_named(Verdict& verdict, const RealGrasp& grasp, const BestDocument<2>& best,
                 const std::vector<RealOptimum>& minima, const std::vector<Chain>& chains) {
  const auto optimum = [&](const char* key, const OptimumClaim& claim, Extremum type) {
    return check_optimum(verdict, Path() / key, grasp, claim, chains, type, best.options);
  };
  check_same(verdict, optimum("best", *best.best, Extremum::min), minima.front(),
             "best is the first of the minima");
  const auto first = std::find_if(minima.begin(), minima.end(), [](const RealOptimum& minimum) {
    return minimum.claim.manner == Manner::pinched && minimum.claim.kind != Kind::boundary;
  });
  verdict.check(Path() / "best_pinched",
                "best_pinched is null where no interior minimum is pinched",
                !best.best_pinched == (first == minima.end()));
  if (best.best_pinched && first != minima.end())
    check_same(verdict, optimum("best_pinched", *best.best_pinched, Extremum::min), *first,
               "best_pinched is the lowest interior minimum that is pinched");
  Real highest = 0;
  for (const Chain& chain : chains)
    for (const RealArc& arc : chain.arcs)
      highest = std::max(highest, arc.value.greatest(arc.from, arc.to));
  const Path place = Path() / "worst";
  verdict.check(place, "where something is held there is a worst posture", best.worst.has_value());
  if (best.worst)
    verdict.check(place, "worst is the highest value of the arcs",
                  difference(value(optimum("worst", *best.worst, Extremum::max).claim), highest,
                             little(grasp, best.options.objective)),
                  1e-6L);
}

/// Checks the lower bound on the value against what is proven.
void check_bound(Verdict& verdict, const RealGrasp& grasp, const BestDocument<2>& best,
                 Real proven) {
  const Path place = Path() / "lower_bound";
  const bool told = best.lower_bound && best.relative_gap;
  verdict.check(place, "where something is held there is a bound and a gap", told);
  if (!told) return;
  const Real lowest = value(*best.best), bound = *best.lower_bound;
  verdict.check(place, "lower_bound is not above what the y of the arcs prove [of the best]",
                (bound - proven) / std::max(lowest, little(grasp, best.options.objective)), 1e-6L);
  const Real gap = lowest > 0 ? (lowest - bound) / lowest : 0;
  verdict.check(Path() / "relative_gap", "relative_gap is (value - lower_bound) / value",
                std::abs(*best.relative_gap - gap), 1e-14L);
  if (best.status == Status::optimal)
    verdict.check(place, "the best is optimal: the gap is closed", gap, 1e-6L);
  else
    verdict.check(Path() / "status", "status is gap only where the gap is open", 1e-6L - gap,
                  1e-9L);
}

}  // namespace

void check_curve(Verdict& verdict, const RealGrasp& grasp, const CurveDocument& curve) {
  const OptionsClaim& options = curve.options;
  check_options(verdict, grasp.dim, options, {"domain", "present_deg", "objective"});
  const auto [arcs, chains] =
      check_pieces(verdict, each_load(grasp), curve, domain_of(grasp, options));
  const Path list = Path() / "optima";
  std::vector<RealOptimum> minima, maxima;
  for (std::size_t k = 0; k < curve.optima.size(); ++k) {
    const Extremum type = curve.optima[k].type.value_or(Extremum::min);
    auto& optima = type == Extremum::max ? maxima : minima;
    optima.push_back(
        check_optimum(verdict, list[k], grasp, curve.optima[k], chains, type, options));
    verdict.check(list[k] / "type", "minima come before maxima",
                  type == Extremum::max || maxima.empty());
  }
  const Real present = radians_of(options.present_deg.value_or(0));
  check_complete(verdict, list, minima, chains, Extremum::min, present);
  check_complete(verdict, list, maxima, chains, Extremum::max, present);
  verdict.unchecked(Path() / "holdable_arcs_deg",
                    "that no posture beside them can be held: best proves it");
}

void check_best(Verdict& verdict, const RealGrasp& grasp, const BestDocument<2>& best) {
  const OptionsClaim& options = best.options;
  check_options(verdict, grasp.dim, options, {"domain", "present_deg", "objective"});
  const RealDomain domain = domain_of(grasp, options);
  const EachLoad grasps = each_load(grasp);
  const auto [arcs, chains] = check_pieces(verdict, grasps, best, domain);
  check_unholdable(verdict, grasps, best.unholdable_arcs, options.force_cap);
  const Real proven =
      check_cover(verdict, grasps, arcs, best.unholdable_arcs, domain, best.status, options);
  const Path list = Path() / "minima";
  std::vector<RealOptimum> minima;
  for (std::size_t k = 0; k < best.minima.size(); ++k) {
    verdict.check(list[k] / "type", "type is told of the optima of a curve", !best.minima[k].type);
    minima.push_back(
        check_optimum(verdict, list[k], grasp, best.minima[k], chains, Extremum::min, options));
  }
  check_complete(verdict, list, minima, chains, Extremum::min,
                 radians_of(options.present_deg.value_or(0)));
  verdict.check(Path() / "best", "best is null where there are no minima",
                !best.best == minima.empty());
  verdict.check(Path() / "status", "status is unholdable only where there are no minima",
                best.status != (minima.empty() ? Status::optimal : Status::unholdable));
  if (best.best && !minima.empty()) {
    check_named(verdict, grasp, best, minima, chains);
    check_bound(verdict, grasp, best, proven);
    return;
  }
  if (best.status == Status::gap)
    verdict.leave_open("Nothing was found that can be held, nor a proof that nothing can.");
  for (const auto& [key, null] :
       {std::pair{"best_pinched", !best.best_pinched}, std::pair{"worst", !best.worst},
        std::pair{"lower_bound", !best.lower_bound}, std::pair{"relative_gap", !best.relative_gap}})
    verdict.check(Path() / key, "is null where nothing is held", null);
}

}  // namespace poise::verify
