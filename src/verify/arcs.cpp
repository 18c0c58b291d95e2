#include <algorithm>
#include <cmath>
#include <tuple>

#include "verify/curve.hpp"
#include "verify/faces.hpp"

namespace poise::verify {
namespace {

using Vec2 = Eigen::Matrix<Real, 2, 1>;

/// What the forces of all contacts amount to, each on its face in the arc's middle.
struct ArcForces {
  Mat3 Q;           ///< twice the dual value is e^T Q e, e = harmonics(theta)
  Mat3 off;         ///< times e: what is left of the load
  Real outside{0};  ///< how far contacts leave their faces along the arc
  Real length{0};   ///< of y, as contacts feel it
};

Real middle_of(const RealArc& arc) { return (arc.from + arc.to) / 2; }

ArcForces check_contacts(Verdict& verdict, const RealGrasp& grasp, const RealArc& arc,
                         const std::vector<ArcState>& states) {
  const Real W = grasp.loads.front().size();
  const Mat3 w = load_matrix(grasp.loads.front());
  ArcForces forces{2 * arc.y.transpose() * w, w, 0, W};
  for (std::size_t i = 0; i < grasp.contacts.size(); ++i) {
    const RealContact& contact = grasp.contacts[i];
    const Mat z = contact.share * contact.G.transpose() * arc.y;  // 2 x 3
    const Face face = face_of(contact, z * harmonics(middle_of(arc)));
    Mat f = face.P * z;
    f.col(0) += face.f0;
    forces.Q -= (2 * z.transpose() * f - f.transpose() * f) / contact.share;
    forces.off -= contact.G * f;
    forces.length =
        std::max(forces.length, (contact.G.cwiseAbs().transpose() * arc.y.cwiseAbs()).sum());
    for (const Vec3& side : face.sides) {
      Vec3 g = z.transpose() * side.tail<2>();
      g[0] += side[0];
      forces.outside =
          std::max(forces.outside, -least(g, arc.from, arc.to) / std::max(z.norm(), W));
    }
    check_arc_state(verdict, (arc.place / "states")[i], contact, W, f * harmonics(middle_of(arc)),
                    states[i]);
  }
  return forces;
}

/// Checks that V is what the forces make of it, or in a single posture its value.
void check_effort(Verdict& verdict, const RealArc& arc, const Mat3& Q, const RealLoad& load) {
  const Path place = arc.place / "V";
  const Effort dual{Q(0, 0) + (Q(1, 1) + Q(2, 2)) / 2, Q(0, 1) + Q(1, 0), Q(0, 2) + Q(2, 0),
                    (Q(1, 1) - Q(2, 2)) / 2, (Q(1, 2) + Q(2, 1)) / 2};
  const Real scale = dual.scale(), middle = middle_of(arc);
  if (arc.from == arc.to) {
    verdict.check(place, "V is twice the dual value of y [of V]",
                  difference(arc.value(middle), dual(middle)), 1e-9L);
    return;
  }
  // A load that does not turn is found by the method for single postures.
  const Real allowed =
      load.turning() == 0 ? 1e-9L : 1e-11L + 4e-15L * std::sqrt(scale) / load.size();
  for (const auto& [key, claimed, expected] :
       {std::tuple{"c0", arc.value.c0, dual.c0}, std::tuple{"cos1", arc.value.cos1, dual.cos1},
        std::tuple{"sin1", arc.value.sin1, dual.sin1},
        std::tuple{"cos2", arc.value.cos2, dual.cos2},
        std::tuple{"sin2", arc.value.sin2, dual.sin2}})
    verdict.check(place / key, "V is twice the dual value of y [of all coefficients]",
                  std::abs(claimed - expected) / scale, allowed);
}

/// Checks that y proves V, but for what its rounding to doubles takes.
void check_proof(Verdict& verdict, const RealGrasp& grasp, const RealArc& arc, Real digits) {
  for (int k = 0; k <= 4; ++k) {
    const Real theta = arc.from + (arc.to - arc.from) * k / 4, V = arc.value(theta);
    const Vec y = arc.y * harmonics(theta), w = wrench(grasp.loads.front(), up_at(theta));
    const Real off = std::abs(V - bound(grasp, w, y)) + bound_rounding(grasp, w, y, {});
    verdict.check(arc.place / "V", "V is what y proves [of V]", V > 0 ? off / V : 1,
                  1e-6L + 4 * digits);
  }
}

void check_effort_arc(Verdict& verdict, const RealGrasp& grasp, const RealArc& arc,
                      const std::vector<ArcState>& states, Real force_cap) {
  const RealLoad& load = grasp.loads.front();
  const ArcForces forces = check_contacts(verdict, grasp, arc, states);
  verdict.check(arc.place, "contacts keep to their faces along the arc [of y]", forces.outside,
                1e-7L);
  // What y loses by its rounding, if it is not so long that nothing is left.
  const Real rounded = 1e-15L * forces.length / load.size();
  const Real digits = std::min(rounded, Real{1e-6L});
  // And of great forces, not more than shows.
  const Real norm = std::sqrt(std::max(arc.value.greatest(arc.from, arc.to), Real{0}));
  verdict.check(arc.place, "forces balance the load along the arc [weights]",
                relative_size(forces.off, load, arc.from, arc.to),
                1e-11L + digits + std::min(rounded, 2e-11L * norm / load.size()));
  check_effort(verdict, arc, forces.Q, load);
  check_proof(verdict, grasp, arc, digits);
  const Real cap = force_cap * load.size();
  verdict.check(arc.place, "V is within the force cap: V / cap^2",
                arc.value.greatest(arc.from, arc.to) / (cap * cap), 1 + 1e-6L);
}

}  // namespace

bool RealArc::is_sliver() const { return from != to && std::abs(to - from) <= end_slack; }

void check_arc_state(Verdict& verdict, const Path& place, const RealContact& contact, Real weight,
                     const Vec& force, const ArcState& claim) {
  // Close to where states meet both are right.
  const Real n = force[0], little = 1e-8L * weight, tiny = 1e-12L * weight;
  const Real left = contact.friction * n - std::abs(force[1]);
  const Real least_left = std::min(tiny, 1e-10L * contact.friction * n);
  verdict.check(place / "state", "state is that of the arc's middle",
                claim.state == ContactState::unloaded   ? n <= little
                : claim.state == ContactState::slipping ? n > tiny && left <= little
                                                        : n > tiny && left > least_left);
  const bool max = n >= contact.most - little;
  const bool min = contact.least > 0 && n <= contact.least + little;
  verdict.check(place / "limit", "limit is that of the arc's middle",
                claim.limit == ForceLimit::max   ? max
                : claim.limit == ForceLimit::min ? min
                : n < 1e-6L * weight
                    ? true
                    : n < contact.most - tiny && (contact.least == 0 || n > contact.least + tiny));
}

EachLoad each_load(const RealGrasp& grasp) {
  EachLoad grasps;
  for (const RealLoad& load : grasp.loads) grasps.push_back(with_load(grasp, load));
  return grasps;
}

std::size_t check_named_load(Verdict& verdict, const Path& place, const EachLoad& grasps,
                             const std::optional<std::size_t>& load) {
  const bool known = grasps.size() == 1 ? !load : load && *load < grasps.size();
  verdict.check(place / "load", "load is one of the grasp's, told where there are several", known);
  return known ? load.value_or(0) : 0;
}

std::vector<RealArc> check_arcs(Verdict& verdict, const Path& list, const EachLoad& grasps,
                                const std::vector<ArcClaim>& claims, const OptionsClaim& options) {
  std::vector<RealArc> arcs;
  for (std::size_t k = 0; k < claims.size(); ++k) {
    const ArcClaim& claim = claims[k];
    RealArc& arc = arcs.emplace_back();
    arc = {list[k], claim.from, claim.to, claim.F ? effort_of(*claim.F) : effort_of(claim.V), {}};
    arc.load = check_named_load(verdict, arc.place, grasps, claim.load);
    const RealGrasp& grasp = grasps[arc.load];
    arc.y << claim.y.c0.cast<Real>(), claim.y.cos1.cast<Real>(), claim.y.sin1.cast<Real>();
    arc.rates.resize(grasp.drives.size());
    if (claim.rates.size() == arc.rates.size())
      std::copy(claim.rates.begin(), claim.rates.end(), arc.rates.begin());
    const bool of_grip = options.objective == Objective::grip;
    verdict.check(arc.place, "an arc is of the objective of the options",
                  claim.F.has_value() == of_grip);
    if (arc.is_sliver()) {
      verdict.unchecked(arc.place,
                        "arcs narrower than 2e-8 rad prove nothing, their neighbours must");
      continue;
    }
    verdict.check(arc.place, "from_deg is not above to_deg, nor by more than a turn below",
                  arc.from <= arc.to && arc.to - arc.from <= 2 * pi + end_slack);
    const bool complete = claim.states.size() == grasp.contacts.size();
    verdict.check(arc.place / "states", "there are as many states as the grasp has contacts",
                  complete);
    if (!complete || claim.F.has_value() != of_grip) continue;
    if (of_grip)
      check_grip_arc(verdict, grasp, arc, claim, options.force_cap);
    else
      check_effort_arc(verdict, grasp, arc, claim.states, options.force_cap);
  }
  return arcs;
}

}  // namespace poise::verify
