#include "poise/best_spatial_posture.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "space/local_minima.hpp"
#include "space/posture_search.hpp"
#include "dual/twist.hpp"

namespace poise {

using search::Cone;
using search::infinity;
using search::pi;
using search::Row;
using search::Scenario;
using search::Search;

namespace {

void check(const std::vector<Grasp<3>>& scenarios, const SpatialSettings& settings) {
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
  if (scenarios.empty()) throw InvalidGrasp("scenarios", "is empty, must hold at least one");
  const auto& first = scenarios.front().contacts();
  for (const Grasp<3>& grasp : scenarios) {
    const auto same = [](const Contact<3>& a, const Contact<3>& b) {
      return a.position == b.position && a.normal == b.normal && a.friction == b.friction &&
             a.torsion == b.torsion && a.share == b.share && a.min_normal == b.min_normal &&
             a.max_normal == b.max_normal && a.finger == b.finger;
    };
    if (!std::equal(first.begin(), first.end(), grasp.contacts().begin(), grasp.contacts().end(),
                    same))
      throw InvalidGrasp("scenarios", "must all have the same contacts");
  }
}

/// With all scenarios' holds. `row`: of the scenario that decides.
SpatialPosture posture(const std::vector<Scenario>& scenarios, const Vector<3>& up,
                       const Row& row) {
  SpatialPosture result;
  result.up = up;
  for (std::size_t s = 0; s < scenarios.size(); ++s) {
    const Grasp<3>& grasp = *scenarios[s].grasp;
    const HoldSettings settings{scenarios[s].cap};
    Hold<3> found = hold(grasp, up, settings);
    // At the border of what can be held rounding may decide.
    if (!found.holdable)
      found = hold<3>(grasp, grasp.load(up), about_origin(grasp, row.y), settings);
    result.scenario_efforts.push_back(found.holdable ? found.effort : infinity);
    if (s > 0 && result.scenario_efforts.back() <= result.scenario_efforts[result.scenario])
      continue;
    result.hold = found;
    result.scenario = s;
  }
  result.manner = manner(*scenarios[result.scenario].grasp, up, result.hold);
  return result;
}
bool only_max_normal(const std::vector<Grasp<3>>& grasps) {
  bool any = false;
  for (const Contact<3>& contact : grasps.front().contacts()) {
    if (contact.min_normal > 0) return false;
    any = any || std::isfinite(contact.max_normal);
  }
  return any;
}

Grasp<3> without_max_normal(const Grasp<3>& grasp) {
  std::vector<Contact<3>> contacts = grasp.contacts();
  for (Contact<3>& contact : contacts) contact.max_normal = infinity;
  return {grasp.object(), std::move(contacts)};
}
}  // namespace

const char* to_string(Status status) {
  constexpr const char* names[] = {"optimal", "gap", "unholdable"};
  return names[static_cast<int>(status)];
}

BestSpatialPosture best_posture(const Grasp<3>& grasp, const SpatialSettings& settings) {
  return best_posture(std::vector<Grasp<3>>{grasp}, settings);
}

BestSpatialPosture best_posture(const std::vector<Grasp<3>>& scenarios,
                                const SpatialSettings& settings) {
  check(scenarios, settings);
  double weight = 0;
  for (const Grasp<3>& grasp : scenarios) weight = std::max(weight, grasp.object().weight);
  std::vector<Scenario> in_units;
  for (const Grasp<3>& grasp : scenarios) {
    const double part = grasp.object().weight / weight;
    in_units.push_back({&grasp, part, std::min(settings.force_cap / part, 1e9)});
  }
  std::vector<Cone> domain;
  if (settings.tilt) domain.push_back({settings.tilt->from.normalized(), settings.tilt->most});

  BestSpatialPosture result;
  // What is proven without max_normal holds with it. Where the best posture needs no more then,
  // that is all; else it is where to begin.
  std::vector<Grasp<3>> strong;
  std::vector<Scenario> unlimited;
  std::optional<Search> easier;
  if (only_max_normal(scenarios)) {
    for (const Grasp<3>& grasp : scenarios) strong.push_back(without_max_normal(grasp));
    for (std::size_t s = 0; s < scenarios.size(); ++s)
      unlimited.push_back({&strong[s], in_units[s].weight, in_units[s].cap});
    easier.emplace(unlimited, domain, settings.gap, (settings.max_holds + 1) / 2);
    easier->run();
  }
  Search full(in_units, domain, settings.gap, settings.max_holds - (easier ? easier->holds() : 0));
  if (easier) full.begin_with(*easier);
  const bool proven =
      easier && full.best_V() <= (1 + 0.1 * settings.gap) * easier->best_V() &&
      (easier->best_V() < infinity || easier->lower_bound() > full.cap() * full.cap());
  if (!proven) full.run();
  Search& prover = proven ? *easier : full;
  const double square = weight * weight, bound = prover.lower_bound();
  result.holds = full.holds() + (easier ? easier->holds() : 0);
  result.cuts = prover.certificate(bound);
  result.lower_bound = square * bound;
  if (!(full.best_V() < infinity)) {
    result.status = bound > full.cap() * full.cap() ? Status::unholdable : Status::gap;
    return result;
  }

  std::vector<std::pair<Vector<3>, Row>> found = {{full.best_up(), full.best_row()}};
  for (const Vector<3>& start : search::starts(full, domain, settings.starts)) {
    const auto minimum = search::descend(in_units, domain, start);
    if (minimum && std::none_of(found.begin(), found.end(), [&](const auto& other) {
          return (other.first - minimum->first).norm() < 1e-3;
        }))
      found.push_back(*minimum);
  }
  for (const auto& [up, row] : found) {
    SpatialPosture minimum = posture(in_units, up, row);
    std::vector<Vector<3>> sharper;
    // The best is found no better than the gap tells.
    if (settings.starts > 0 && result.minima.empty())
      if (const auto lower = search::descend(in_units, domain, up)) sharper.push_back(lower->first);
    if (in_units.size() == 1 && domain.empty())
      sharper.push_back(search::settled(in_units.front(), up, row));
    for (const Scenario& scenario : in_units)
      for (const Vector<3>& alone : search::on_one_contact(*scenario.grasp))
        if ((alone - up).norm() < 1e-4 && (domain.empty() || domain.front().excess(alone) <= 0))
          sharper.push_back(alone);
    for (const Vector<3>& other : sharper) {
      SpatialPosture there = posture(in_units, other, row);
      if (there.hold.holdable && there.effort() <= (1 + 1e-9) * minimum.effort())
        minimum = std::move(there);
    }
    if (minimum.hold.holdable) result.minima.push_back(std::move(minimum));
  }
  if (result.minima.empty()) return result;  // within rounding of the limit of holding
  std::stable_sort(
      result.minima.begin(), result.minima.end(),
      [](const SpatialPosture& a, const SpatialPosture& b) { return a.effort() < b.effort(); });
  result.best = result.minima.front();
  const double effort = result.best->effort();
  result.lower_bound = std::min(result.lower_bound, effort);
  result.relative_gap = (effort - result.lower_bound) / effort;
  result.status = result.relative_gap <= settings.gap ? Status::optimal : Status::gap;
  for (std::size_t i = 0; i < result.minima.size() && !result.pinched; ++i) {
    const SpatialPosture& minimum = result.minima[i];
    if (minimum.manner != Manner::pinched) continue;
    bool interior = true;
    const Eigen::Matrix<double, 3, 2> across = tangents(minimum.up);
    for (int k = 0; k < 8 && interior; ++k) {
      const Vector<3> beside =
          (minimum.up + 1e-6 * (across * Vector<2>(std::cos(k * pi / 4), std::sin(k * pi / 4))))
              .normalized();
      for (const Cone& cone : domain) interior = interior && !(cone.excess(beside) > 0);
      for (const Scenario& scenario : in_units)
        interior = interior && hold(*scenario.grasp, beside, {scenario.cap}).holdable;
    }
    if (interior) result.pinched = i;
  }
  return result;
}

Eigen::Quaterniond smallest_turn(const Eigen::Quaterniond& orientation, const Vector<3>& up) {
  const Vector<3> now = (orientation.normalized() * up).normalized();
  // From `now` to z: by half the angle, w = cos and the axis times sin.
  const Vector<3> axis = now.cross(Vector<3>::UnitZ());
  const double across = axis.norm(), angle = std::atan2(across, now.z());
  if (!(across > 1e-15))
    return now.z() > 0 ? Eigen::Quaterniond::Identity() : Eigen::Quaterniond(0, 1, 0, 0);
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis / across));
}

}  // namespace poise
