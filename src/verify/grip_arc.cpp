#include <algorithm>
#include <cmath>
#include <limits>

#include "verify/checks.hpp"
#include "verify/curve.hpp"

namespace poise::verify {
namespace {

Vec3 coefficients(const Harmonic1& g) { return {g.c0, g.cos1, g.sin1}; }

/// The forces of the contacts all along an arc.
struct AlongArc {
  std::vector<Mat> forces;  ///< rows: normal and tangential, times harmonics(theta)
  Real size{0};             ///< of all of them and the weight, for what rounding leaves of them
};

AlongArc along(const RealGrasp& grasp, const RealArc& arc, const ArcClaim& claim) {
  AlongArc result{{}, grasp.loads.front().size()};
  for (const ArcForce& force : claim.forces) {
    Mat& f = result.forces.emplace_back(2, 3);
    f.row(0) = coefficients(force.normal);
    f.row(1) = coefficients(force.tangential);
    for (int row = 0; row < 2; ++row) result.size += greatest_size(f.row(row), arc.from, arc.to);
  }
  return result;
}

/// Checks that the forces balance, and keep to the cones and the limits.
void check_forces(Verdict& verdict, const RealGrasp& grasp, const RealArc& arc,
                  const ArcClaim& claim, const AlongArc& along) {
  const RealLoad& load = grasp.loads.front();
  const Real digits = 1e-12L * along.size / load.size();
  Mat3 off = load_matrix(load);
  for (std::size_t i = 0; i < along.forces.size(); ++i) {
    const RealContact& contact = grasp.contacts[i];
    const Mat& f = along.forces[i];
    const Vec3 n = f.row(0), t = f.row(1), one(1, 0, 0);
    off -= contact.G * f;
    const Real steep = std::sqrt(1 + contact.friction * contact.friction);
    Real inside = std::min(least((contact.friction * n - t) / steep, arc.from, arc.to),
                           least((contact.friction * n + t) / steep, arc.from, arc.to));
    inside = std::min(inside, least(n - contact.least * one, arc.from, arc.to));
    if (std::isfinite(contact.most))
      inside = std::min(inside, least(contact.most * one - n, arc.from, arc.to));
    verdict.check((arc.place / "forces")[i],
                  "force is within the friction cone and its limits along the arc [weights]",
                  -inside / load.size(), 1e-11L + digits);
    check_arc_state(verdict, (arc.place / "states")[i], contact, load.size(),
                    f * harmonics((arc.from + arc.to) / 2), claim.states[i]);
  }
  verdict.check(arc.place, "forces balance the load along the arc [weights]",
                relative_size(off, load, arc.from, arc.to), 1e-11L + digits);
}

/// The effort of a drive, in the unit of the grip, times harmonics(theta).
Vec3 effort_along(const RealGrasp& grasp, const RealDrive& drive, const AlongArc& along) {
  Vec3 effort = Vec3::Zero();
  for (std::size_t i = 0; i < along.forces.size(); ++i)
    for (const RealDrive::Moved& moved : drive.moves)
      if (moved.finger == grasp.contacts[i].finger)
        effort += (moved.twist.transpose() * grasp.contacts[i].G * along.forces[i]).transpose() /
                  grasp.unit(drive);
  return effort;
}

}  // namespace

Vec3 grip_proof(const RealGrasp& grasp, const Vec& y, const std::vector<Real>& rates,
                Real force_cap) {
  const RealLoad& load = grasp.loads.front();
  Vec3 g = load_matrix(load).transpose() * y.head<3>();
  g[0] += grip_bound(grasp, Vec::Zero(3), y, rates, force_cap * load.size());
  return g;
}

void check_grip_arc(Verdict& verdict, const RealGrasp& grasp, const RealArc& arc,
                    const ArcClaim& claim, Real force_cap) {
  const bool complete = claim.forces.size() == grasp.contacts.size();
  verdict.check(arc.place / "forces", "there are as many forces as the grasp has contacts",
                complete);
  const bool all_rates = claim.rates.size() == grasp.drives.size() && !grasp.drives.empty();
  verdict.check(arc.place / "rates", "there are as many rates as the grasp has drives", all_rates);
  if (!complete || !all_rates || !real_rates(verdict, arc.place, grasp, claim.rates)) return;
  const AlongArc forces = along(grasp, arc, claim);
  check_forces(verdict, grasp, arc, claim, forces);

  // No drive does more than F, and y and the rates prove that none could do with less: in each
  // posture but for a part of F there.
  const Vec3 F(arc.value.c0, arc.value.cos1, arc.value.sin1);
  const Real low = arc.value.least(arc.from, arc.to);
  const Real unit = std::max(low, little(grasp, Objective::grip));
  const Real digits = std::min(1e-14L * arc.value.scale() / unit, Real{1e-6L});
  const Path place = arc.place / "F";
  verdict.check(place, "F is at least 0 [of F]", -low / unit, 1e-9L);
  Real most = std::numeric_limits<Real>::infinity(), sum = 0;
  for (std::size_t a = 0; a < grasp.drives.size(); ++a) {
    const RealDrive& drive = grasp.drives[a];
    most = std::min(most, drive.max / grasp.unit(drive));
    sum += arc.rates[a];
    const Vec3 left = (1 + 1e-8L) * F - effort_along(grasp, drive, forces);
    verdict.check(place, "no drive does more than F along the arc, but for a part of 1e-8 [of F]",
                  -least(left, arc.from, arc.to) / unit, 1e-8L + digits);
  }
  verdict.check(place, "F is within what the drives give",
                arc.value.greatest(arc.from, arc.to) / most, 1 + 1e-7L);
  verdict.check(arc.place / "rates", "rates add up to 1 at most", sum - 1, rounding);
  const Vec3 off = F - grip_proof(grasp, arc.y.col(0), arc.rates, force_cap);
  const Real above = -least(1e-7L * F - off, arc.from, arc.to);
  const Real below = -least(1e-7L * F + off, arc.from, arc.to);
  verdict.check(place, "F is what y and rates prove along the arc, but for a part of 1e-7 [of F]",
                std::max(above, below) / unit, 1e-7L + digits);
}

}  // namespace poise::verify
