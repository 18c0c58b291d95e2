#include <algorithm>
#include <cmath>

#include "verify/checks.hpp"

namespace poise::verify {
namespace {

/// How much of the friction a contact uses, and its state; both open within rounding of a limit.
template <int Dim>
void check_state(Verdict& verdict, const Path& place, const RealContact& contact, Real weight,
                 const ContactClaim<Dim>& claim, Real sideways) {
  const Real n = claim.normal_force, most = contact.friction * n;
  const bool clear = !is_beside(n, at_limit * weight, weight);
  const bool pressing = clear ? n > at_limit * weight : claim.state != ContactState::unloaded;
  const Real used = !pressing ? 0 : most > 0 ? std::min(Real{1}, sideways / most) : 1;
  const Real claimed = claim.friction_used;
  verdict.check(place / "friction_used", "friction_used is tangential / (friction * normal)",
                std::abs(claimed - used), 1e-11L * std::max(claimed, Real{1e-3L}));
  const bool slips = is_beside(used, 1 - at_limit, 1) ? claim.state == ContactState::slipping
                                                      : used > 1 - at_limit;
  verdict.check(place / "state", "state follows from the forces",
                claim.state == (!pressing ? ContactState::unloaded
                                : slips   ? ContactState::slipping
                                          : ContactState::sticking));
}

template <int Dim>
void check_limit(Verdict& verdict, const Path& place, const RealContact& contact, Real weight,
                 const ContactClaim<Dim>& claim) {
  const Real n = claim.normal_force;
  const bool max = n >= contact.most - at_limit * weight;
  const bool min = contact.least > 0 && n <= contact.least + at_limit * weight;
  const bool open = is_beside(n, contact.most - at_limit * weight, weight) ||
                    is_beside(n, contact.least + at_limit * weight, weight);
  verdict.check(place / "limit", "limit follows from normal_force",
                open || claim.limit == (max   ? ForceLimit::max
                                        : min ? ForceLimit::min
                                              : ForceLimit::none));
}

}  // namespace

bool is_beside(Real number, Real limit, Real unit) {
  return std::abs(number - limit) <= 1e-12L * unit;
}

template <int Dim>
Vec check_contact(Verdict& verdict, const Path& place, const RealContact& contact, Real weight,
                  const ContactClaim<Dim>& claim) {
  verdict.check(place, "finger is that of the grasp", claim.finger == contact.finger);
  const Vec vector = real(claim.force);
  Vec force = contact.G.topRows(Dim).transpose() * vector;
  const Real along = Dim == 2 ? force[1] : force.tail(force.size() - 1).norm();
  verdict.check(place / "normal_force", "normal_force is that of force",
                std::abs(force[0] - claim.normal_force), rounding * vector.norm());
  verdict.check(place / "tangential_force", "tangential_force is that of force",
                std::abs(along - claim.tangential_force), rounding * vector.norm());
  Real sideways = std::abs(Real{claim.tangential_force});
  verdict.check(place / "torsion_moment", "a soft finger alone has its moment",
                claim.torsion_moment.has_value() == contact.is_soft());
  if (contact.is_soft()) {
    force[3] = claim.torsion_moment.value_or(0) / contact.G.col(3).tail(3).norm();
    sideways = std::hypot(sideways, force[3]);
  }
  check_state(verdict, place, contact, weight, claim, sideways);
  check_limit(verdict, place, contact, weight, claim);
  return force;
}

template Vec check_contact(Verdict&, const Path&, const RealContact&, Real, const ContactClaim<2>&);
template Vec check_contact(Verdict&, const Path&, const RealContact&, Real, const ContactClaim<3>&);

}  // namespace poise::verify
