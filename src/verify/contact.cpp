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

/// Checks what is told of a pad, and writes how its parts press; returns the sum of the tangential
/// forces of its points, each by its size.
Real check_pad(Verdict& verdict, const Path& place, const RealContact& contact, Real weight,
               const ContactClaim<3>& claim, Vec& force) {
  const RealPad& pad = *contact.pad;
  const Vec vector = real(claim.force);
  const Real normal = contact.normal.dot(vector);
  const bool complete = claim.point_forces && claim.point_forces->size() == pad.points.size();
  verdict.check(place / "point_forces", "there is a force of each point of the pad", complete);
  force = Vec::Zero(contact.G.cols());
  force[0] = normal;
  if (!complete || !claim.center_of_pressure) return 0;

  Real sizes = 0, twisted = 0, arms = 0;
  Vec rest = vector - normal * contact.normal;
  for (std::size_t k = 0; k < pad.points.size(); ++k) {
    const Vec t = real((*claim.point_forces)[k]);
    const auto column = static_cast<Eigen::Index>(1 + 2 * k);
    force.segment(column, 2) = contact.G.block(0, column, 3, 2).transpose() * t;
    verdict.check((place / "point_forces")[k], "it is at right angles to the normal [of force]",
                  std::abs(t.dot(contact.normal)), rounding * std::max(t.norm(), vector.norm()));
    rest -= t;
    sizes += t.norm();
    twisted += contact.normal.dot(wrench(t, pad.points[k].place).tail(3));
    arms += t.norm() * pad.points[k].place.norm();
  }
  verdict.check(place / "point_forces", "they add up to the tangential force", rest.norm(),
                rounding * (vector.norm() + sizes));
  verdict.check(place / "torsion_moment", "torsion_moment is that of point_forces",
                std::abs(claim.torsion_moment.value_or(0) - twisted), rounding * arms);

  // The normal force acts at the centre of pressure: that is a moment about the middle.
  const Vec moved = real(*claim.center_of_pressure) - contact.middle();
  const Vec moment = normal * wrench(contact.normal, moved).tail(3);
  Real extent = 1e-4L + contact.middle().norm();  // [m]
  for (const RealPad::Point& point : pad.points) extent = std::max(extent, point.place.norm());
  verdict.check(place / "center_of_pressure", "it is in the plane of the pad",
                std::abs(moved.dot(contact.normal)), 1e-11L * extent);
  if (normal <= at_limit * weight)
    verdict.unchecked(place / "center_of_pressure",
                      "of a pad that carries nothing it says nothing");
  Eigen::Index at = 1 + 2 * static_cast<Eigen::Index>(pad.points.size());
  for (const RealPad::Tilt& tilt : pad.tilts) {
    const Real along = moment.dot(tilt.axis);
    if (tilt.reach > 0)
      force[at] = along / tilt.gyration;
    else
      verdict.check(place / "center_of_pressure", "where it cannot move it is in the middle",
                    std::abs(along), 1e-11L * extent * std::max(normal, weight));
    ++at;
  }
  return sizes;
}
Real check_pad(Verdict&, const Path&, const RealContact&, Real, const ContactClaim<2>&, Vec&) {
  return 0;
}

template <int Dim>
Vec check_contact(Verdict& verdict, const Path& place, const RealContact& contact, Real weight,
                  const ContactClaim<Dim>& claim) {
  verdict.check(place, "finger is that of the grasp", claim.finger == contact.finger);
  const Vec vector = real(claim.force);
  Vec force = contact.G.topRows(Dim).transpose() * vector;
  const Vec beside = vector - contact.normal.dot(vector) * contact.normal;
  const Real along = Dim == 2 ? force[1] : beside.norm();
  verdict.check(place / "normal_force", "normal_force is that of force",
                std::abs(force[0] - claim.normal_force), rounding * vector.norm());
  verdict.check(place / "tangential_force", "tangential_force is that of force",
                std::abs(along - claim.tangential_force), rounding * vector.norm());
  Real sideways = std::abs(Real{claim.tangential_force});
  const bool is_pad = contact.pad.has_value();
  verdict.check(place / "torsion_moment", "a soft finger or a pad alone has its moment",
                claim.torsion_moment.has_value() == (contact.is_soft() || is_pad));
  verdict.check(
      place, "a pad alone has its center_of_pressure and point_forces",
      claim.center_of_pressure.has_value() == is_pad && claim.point_forces.has_value() == is_pad);
  if (is_pad) sideways = check_pad(verdict, place, contact, weight, claim, force);
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
