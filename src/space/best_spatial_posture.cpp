#include "poise/best_posture.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "dual/twist.hpp"
#include "space/local_minima.hpp"
#include "space/posture_search.hpp"


namespace poise {

using search::Case;
using search::Cone;
using search::infinity;
using std::numbers::pi;
using search::Row;
using search::Search;

namespace {

void check(const SpatialSettings& settings) {
  if (!(settings.gap > 0) || !(settings.gap < 1))
    throw InvalidGrasp("gap", "must be above 0 and below 1");
  if (settings.max_holds < 1) throw InvalidGrasp("max_holds", "must be at least 1");
  if (settings.starts < 0) throw InvalidGrasp("starts", "must be at least 0");
  if (!(settings.force_cap > 0) || !(settings.force_cap <= 1e9))
    throw InvalidGrasp("force_cap", "must be above 0 and at most 1e9 weights");
  if (settings.tilt) {
    if (!(std::abs(settings.tilt->from.squaredNorm() - 1) <= 1e-6))
      throw InvalidGrasp("tilt.from", "must be a unit vector");
    if (!(settings.tilt->most >= 0) || !(settings.tilt->most <= pi / 2 + 1e-12))
      throw InvalidGrasp("tilt.most", "must be at least 0 and at most 90 degrees");
  }
}

/// With the holds of all loads. `row`: of the load that decides.
Posture<3> posture(const Grasp<3>& grasp, const std::vector<Case>& cases, const Vector<3>& up,
                   const Row& row) {
  std::vector<Hold<3>> holds;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const Load<3>& load = grasp.loads()[k];
    const HoldSettings settings{cases[k].cap};
    holds.push_back(hold(grasp, load, up, settings));
    // At the border of what can be held rounding may decide.
    if (!holds.back().holdable)
      holds.back() = hold<3>(grasp, load.at(up), load.weight,
                             about_origin(grasp.scaled(), load.weight, row.y), settings);
  }
  return posture_of(grasp, up, std::move(holds));
}

bool only_max_normal(const Grasp<3>& grasp) {
  bool any = false;
  for (const Contact<3>& contact : grasp.contacts()) {
    if (contact.min_normal > 0) return false;
    any = any || std::isfinite(contact.max_normal);
  }
  return any;
}

std::vector<Case> cases_of(const Grasp<3>& grasp, const ScaledHand<3>& hand, double force_cap) {
  std::vector<Case> cases;
  for (const Load<3>& load : grasp.loads())
    cases.emplace_back(hand, load, grasp.weight(), force_cap);
  return cases;
}

/// Whether the posture lies inside the domain and what can be held.
bool interior(const Grasp<3>& grasp, const std::vector<Case>& cases, const std::vector<Cone>& domain,
              const Vector<3>& up) {
  const Eigen::Matrix<double, 3, 2> across = tangents(up);
  for (int k = 0; k < 8; ++k) {
    const Vector<2> way(std::cos(k * pi / 4), std::sin(k * pi / 4));
    const Vector<3> beside = (up + 1e-6 * (across * way)).normalized();
    for (const Cone& cone : domain)
      if (cone.excess(beside) > 0) return false;
    for (std::size_t s = 0; s < cases.size(); ++s)
      if (!hold(grasp, grasp.loads()[s], beside, {cases[s].cap}).holdable) return false;
  }
  return true;
}

}  // namespace

Best<3> best_posture(const Grasp<3>& grasp, const SpatialSettings& settings) {
  check(settings);
  const std::vector<Case> cases = cases_of(grasp, grasp.scaled(), settings.force_cap);
  std::vector<Cone> domain;
  if (settings.tilt) domain.push_back({settings.tilt->from.normalized(), settings.tilt->most});

  Best<3> result;
  // What is proven without max_normal holds with it. Where the best posture needs no more then,
  // that is all; else it is where to begin.
  std::optional<ScaledHand<3>> strong;
  std::vector<Case> unlimited;
  std::optional<Search> easier;
  if (only_max_normal(grasp)) {
    strong = grasp.scaled().without_max_normal();
    unlimited = cases_of(grasp, *strong, settings.force_cap);
    easier.emplace(grasp, unlimited, domain, settings.gap, (settings.max_holds + 1) / 2);
    easier->run();
  }
  Search full(grasp, cases, domain, settings.gap, settings.max_holds - (easier ? easier->holds() : 0));
  if (easier) full.begin_with(*easier);
  const bool proven =
      easier && full.best_V() <= (1 + 0.1 * settings.gap) * easier->best_V() &&
      (easier->best_V() < infinity || easier->lower_bound() > full.cap() * full.cap());
  if (!proven) full.run();
  Search& prover = proven ? *easier : full;
  const double square = grasp.weight() * grasp.weight(), bound = prover.lower_bound();
  result.proof.holds = full.holds() + (easier ? easier->holds() : 0);
  result.proof.cuts = prover.certificate(bound);
  result.lower_bound = square * bound;
  if (!(full.best_V() < infinity)) {
    result.status = bound > full.cap() * full.cap() ? Status::unholdable : Status::gap;
    return result;
  }

  std::vector<std::pair<Vector<3>, Row>> found = {{full.best_up(), full.best_row()}};
  for (const Vector<3>& start : search::starts(full, domain, settings.starts)) {
    const auto minimum = search::descend(grasp, cases, domain, start);
    if (minimum && std::none_of(found.begin(), found.end(), [&](const auto& other) {
          return (other.first - minimum->first).norm() < 1e-3;
        }))
      found.push_back(*minimum);
  }
  for (const auto& [up, row] : found) {
    Posture<3> minimum = posture(grasp, cases, up, row);
    std::vector<Vector<3>> sharper;
    // The best is found no better than the gap tells.
    if (settings.starts > 0 && result.minima.empty())
      if (const auto lower = search::descend(grasp, cases, domain, up))
        sharper.push_back(lower->first);
    if (cases.size() == 1 && domain.empty())
      sharper.push_back(search::settled(cases.front(), up, row));
    for (const Vector<3>& alone : search::on_one_contact(grasp))
      if ((alone - up).norm() < 1e-4 && (domain.empty() || domain.front().excess(alone) <= 0))
        sharper.push_back(alone);
    for (const Vector<3>& other : sharper) {
      Posture<3> there = posture(grasp, cases, other, row);
      if (there.holdable() && there.effort() <= (1 + 1e-9) * minimum.effort())
        minimum = std::move(there);
    }
    if (minimum.holdable()) result.minima.push_back({std::move(minimum)});
  }
  if (result.minima.empty()) return result;  // within rounding of the limit of holding
  std::stable_sort(
      result.minima.begin(), result.minima.end(),
      [](const Posture<3>& a, const Posture<3>& b) { return a.effort() < b.effort(); });
  const double effort = result.best().effort();
  result.lower_bound = std::min(result.lower_bound, effort);
  result.relative_gap = (effort - result.lower_bound) / effort;
  result.status = result.relative_gap <= settings.gap ? Status::optimal : Status::gap;
  for (std::size_t i = 0; i < result.minima.size() && !result.pinched; ++i)
    if (result.minima[i].manner == Manner::pinched &&
        interior(grasp, cases, domain, result.minima[i].up))
      result.pinched = i;
  return result;
}

}  // namespace poise
