#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "dual/twist.hpp"
#include "poise/best_posture.hpp"
#include "space/local_minima.hpp"
#include "space/nearest_tie.hpp"
#include "space/search.hpp"

namespace poise {

using search::Digits;
using search::HalfSpace;
using search::infinity;
using search::Oracle;
using search::scaled_loads;
using search::ScaledLoad;
using search::SearchState;
using search::TiltCone;
using std::numbers::pi;

namespace {

/// Minima closer than this [rad] are one.
constexpr double same_posture = 1e-3;
/// Postures this close to one in which a contact carries alone [rad] are meant to be it.
constexpr double near_one_contact = 1e-4;
/// Of two postures whose efforts differ by less, the sharper one is taken.
constexpr double same_effort = 1e-9;
/// Postures this far around [rad] tell whether one is inside what can be held.
constexpr double around = 1e-6;

bool only_max_normal(const Grasp<3>& grasp) {
  bool any = false;
  for (const Contact<3>& contact : grasp.contacts()) {
    if (contact.min_normal > 0) return false;
    any = any || std::isfinite(contact.max_normal);
  }
  return any;
}

/// The search for the best posture of one grasp.
struct Task {
  const Grasp<3>& grasp;
  const SpatialSettings& settings;
  std::vector<ScaledLoad> loads;
  std::vector<TiltCone> domain;
};

/// The state of a search that went for the best posture, and in `best` what no posture is below.
SearchState prove(const Task& task, Best<3>& best) {
  const auto& [grasp, settings, loads, domain] = task;
  SearchState full(Oracle(grasp, loads, settings.objective), domain, settings.gap,
                   Digits::as_needed);
  // What is proven without max_normal holds with it. Where the best posture needs no more then,
  // that is all; else it is where to begin.
  std::optional<ScaledHand<3>> strong;
  std::vector<ScaledLoad> unlimited;
  std::optional<SearchState> easier;
  bool is_proven = false;
  int spent = 0;
  const bool is_plain = settings.objective == Objective::effort && !grasp.is_general();
  if (is_plain && only_max_normal(grasp)) {
    strong = grasp.scaled().without_max_normal();
    unlimited = scaled_loads(grasp, *strong, settings.force_cap);
    easier.emplace(Oracle(grasp, unlimited), domain, settings.gap, Digits::as_needed);
    minimise(*easier, (settings.max_holds + 1) / 2);
    spent = easier->oracle.holds;
    full.begin_with(*easier);
    is_proven = full.best_value <= (1 + 0.1 * settings.gap) * easier->best_value &&
                (easier->best_value < infinity || lower_bound(*easier) > full.oracle.most);
  }
  if (!is_proven) minimise(full, settings.max_holds - spent);
  SearchState& prover = is_proven ? *easier : full;
  const double claimed = lower_bound(prover);
  best.proof.holds = full.oracle.holds + spent;
  best.proof.cuts = certificate(prover, claimed);
  const double bound =
      search::proven_bound(grasp, best.proof.cuts, prover.oracle, settings, claimed);
  const double unit = full.oracle.unit;
  best.lower_bound =
      settings.objective == Objective::grip ? unit * std::sqrt(bound) : unit * unit * bound;
  const bool is_unholdable = !(full.best_value < infinity) && bound > full.oracle.most;
  best.status = is_unholdable ? Status::unholdable : Status::gap;
  return full;
}

/// The best, and the local minima that descents lead to.
std::vector<HalfSpace> lowest_postures(const Task& task, SearchState& state) {
  std::vector<HalfSpace> found = {state.best};
  for (const Vector<3>& start : search::starts(state, task.settings.starts)) {
    const auto lowest =
        search::descend(task.grasp, task.loads, task.domain, task.settings.objective, start);
    if (lowest && std::none_of(found.begin(), found.end(), [&](const HalfSpace& other) {
          return (other.x - lowest->x).norm() < same_posture;
        }))
      found.push_back(*lowest);
  }
  return found;
}

/// With the holds of all loads. `y`: of one of them.
Posture<3> posture(const Task& task, const Vector<3>& up, const Twist<3>& y) {
  std::vector<Hold<3>> holds;
  for (std::size_t k = 0; k < task.loads.size(); ++k) {
    const Load<3>& load = task.grasp.loads()[k];
    const double unit = load.size(task.grasp.length());
    const HoldSettings settings{task.loads[k].cap, task.settings.objective};
    holds.push_back(hold(task.grasp, load, up, settings));
    // At the border of what can be held rounding may decide.
    if (!holds.back().holdable)
      holds.back() = hold<3>(task.grasp, load.at(up), unit,
                             about_origin(task.grasp.scaled(), unit, y), settings);
  }
  return posture_of(task.grasp, up, std::move(holds));
}

/// The posture that was found but for the gap, or rounding. `so_far`: with the better ones.
Posture<3> refined(const Task& task, const HalfSpace& found, const Best<3>& so_far) {
  std::vector<Vector<3>> sharper;
  if (so_far.minima.empty() && task.settings.starts > 0)
    if (const auto lower =
            search::descend(task.grasp, task.loads, task.domain, task.settings.objective, found.x))
      sharper.push_back(lower->x);
  if (task.loads.size() == 1 && task.domain.empty() && !task.grasp.is_general() &&
      task.settings.objective == Objective::effort)
    sharper.push_back(search::polished_minimum(task.loads.front(), found));
  for (const Vector<3>& alone : search::on_one_contact(task.grasp))
    if ((alone - found.x).norm() < near_one_contact &&
        (task.domain.empty() || task.domain.front().excess(alone) <= 0))
      sharper.push_back(alone);
  Posture<3> lowest = posture(task, found.x, found.y);
  for (const Vector<3>& up : sharper) {
    Posture<3> other = posture(task, up, found.y);
    if (other.holdable() && other.value() <= (1 + same_effort) * lowest.value())
      lowest = std::move(other);
  }
  return lowest;
}

/// Whether the posture lies inside the domain and what can be held.
bool is_interior(const Task& task, const Vector<3>& up) {
  const Eigen::Matrix<double, 3, 2> across = tangents(up);
  for (int k = 0; k < 8; ++k) {
    const Vector<2> way(std::cos(k * pi / 4), std::sin(k * pi / 4));
    const Vector<3> neighbour = (up + around * (across * way)).normalized();
    for (const TiltCone& cone : task.domain)
      if (cone.excess(neighbour) > 0) return false;
    for (std::size_t s = 0; s < task.loads.size(); ++s)
      if (!hold(task.grasp, task.grasp.loads()[s], neighbour,
                {task.loads[s].cap, task.settings.objective})
               .holdable)
        return false;
  }
  return true;
}

/// Orders the minima, and says how sure the best is and which is pinched.
void classify(const Task& task, Best<3>& best) {
  std::stable_sort(best.minima.begin(), best.minima.end(),
                   [](const Posture<3>& a, const Posture<3>& b) { return a.value() < b.value(); });
  const double value = best.best().value();
  best.lower_bound = std::min(best.lower_bound, value);
  best.relative_gap = value > 0 ? (value - best.lower_bound) / value : 0;
  best.status = best.relative_gap <= task.settings.gap ? Status::optimal : Status::gap;
  for (std::size_t i = 0; i < best.minima.size() && !best.pinched; ++i)
    if (best.minima[i].manner == Manner::pinched && is_interior(task, best.minima[i].up))
      best.pinched = i;
}

Task task_of(const Grasp<3>& grasp, const SpatialSettings& settings) {
  Task task{grasp, settings, scaled_loads(grasp, grasp.scaled(), settings.force_cap), {}};
  if (settings.tilt) task.domain.push_back({settings.tilt->from.normalized(), settings.tilt->most});
  return task;
}

}  // namespace

bool is_interior(const Grasp<3>& grasp, const SpatialSettings& settings, const Vector<3>& up) {
  return is_interior(task_of(grasp, settings), up);
}

Best<3> best_posture(const Grasp<3>& grasp, const SpatialSettings& settings) {
  search::check_search(settings);
  if (settings.starts < 0) throw InvalidGrasp("starts", "must be at least 0");
  const Task task = task_of(grasp, settings);
  Best<3> best;
  SearchState state = prove(task, best);
  if (!(state.best_value < infinity)) return best;
  for (const HalfSpace& found : lowest_postures(task, state)) {
    Posture<3> minimum = refined(task, found, best);
    if (minimum.holdable()) best.minima.push_back({std::move(minimum)});
  }
  if (best.holdable()) classify(task, best);  // else within rounding of the limit of holding
  return best;
}

}  // namespace poise
