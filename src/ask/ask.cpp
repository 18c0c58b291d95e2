#include "ask/ask.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "ask/turn.hpp"
#include "files/degrees.hpp"
#include "poise/grip.hpp"
#include "poise/turn.hpp"
#include "shape/sizes.hpp"
#include "space/nearest_tie.hpp"

namespace poise {
namespace {

/// A peak that is above what is needed now by no more than this part is no harder press.
constexpr double same_peak = 1e-9;

bool posture_given(const Question& question) { return question.angle_deg || !question.up.empty(); }

/// theta, where it is told as an angle.
std::optional<double> angle(const PlanarFile& file, const Question& question) {
  if (!question.up.empty()) return {};
  return question.angle_deg ? radians(*question.angle_deg) : file.angle.value_or(0);
}

/// The option by which a posture was given.
const char* posture_option(const Question& question) {
  if (question.command == Command::turn) return "to";
  return question.angle_deg ? "angle" : "up";
}

/// The posture that was given.
Vector<2> given_up(const PlanarFile& file, const Question& question) {
  if (question.up.size() == 3)
    throw Misfit(posture_option(question), "has 3 numbers, must have 2:", 2);
  if (question.up.empty()) return up_at(*angle(file, question));
  return Vector<2>(question.up.data()).stableNormalized();
}

Vector<3> given_up(const SpatialFile&, const Question& question) {
  const char* const option = posture_option(question);
  if (question.angle_deg)
    throw Misfit(option,
                 option == std::string("to") ? "has 1 number, must have 3:" : "is for the plane,",
                 3);
  if (question.up.size() == 2) throw Misfit(option, "has 2 numbers, must have 3:", 3);
  return Vector<3>(question.up.data()).stableNormalized();
}

/// The posture in which the object is held now, if the file says so.
std::optional<Vector<2>> present_up(const PlanarFile& file) {
  return file.angle ? std::optional(up_at(*file.angle)) : std::nullopt;
}

std::optional<Vector<3>> present_up(const SpatialFile& file) { return file.up; }

template <int Dim>
Vector<Dim> upright() {
  return Vector<Dim>::Unit(Dim - 1);
}

template <int Dim>
Vector<Dim> up_of(const FileOf<Dim>& file, const Question& question) {
  return posture_given(question) ? given_up(file, question)
                                 : present_up(file).value_or(upright<Dim>());
}

/// That of the file, or what the options make of it.
std::optional<Tilt> tilt_of(const SpatialFile& file, const Question& question) {
  const auto& [from, most_deg] = std::tie(question.tilt_from, question.tilt_max_deg);
  if (!from && !most_deg) return file.tilt;
  if (!file.tilt && !most_deg) throw Misfit("tilt-from", "needs --tilt-max, or a tilt in", 0);
  if (!file.tilt && !from) throw Misfit("tilt-max", "needs --tilt-from, or a tilt in", 0);
  Tilt tilt = file.tilt.value_or(Tilt{});
  if (from) tilt.from = *from;
  if (most_deg) tilt.most = radians(*most_deg);
  return tilt;
}

template <int Dim>
HoldSettings hold_settings(const FileOf<Dim>& file, const Question& question) {
  return {.force_cap = question.force_cap,
          .objective = question.objective.value_or(file.objective)};
}

CurveSettings curve_settings(const PlanarFile& file, const Question& question) {
  return {.domain = question.domain.value_or(file.domain),
          .force_cap = question.force_cap,
          .objective = question.objective.value_or(file.objective),
          .present = file.angle.value_or(0)};
}

SpatialSettings spatial_settings(const SpatialFile& file, const Question& question,
                                 bool is_general) {
  SpatialSettings settings;
  settings.force_cap = question.force_cap;
  settings.objective = question.objective.value_or(file.objective);
  if (settings.objective == Objective::grip || is_general) settings.starts = 0;
  settings.gap = question.gap.value_or(settings.gap);
  settings.max_holds = question.max_holds.value_or(settings.max_holds);
  settings.tilt = tilt_of(file, question);
  return settings;
}

Eigen::Quaterniond present_orientation(const SpatialFile& file, const Question& question) {
  if (question.orientation) return *question.orientation;
  return file.up ? orientation_of(*file.up) : Eigen::Quaterniond::Identity();
}

TurnSettings turn_settings(const SpatialSettings& settings) {
  return {.objective = settings.objective, .force_cap = settings.force_cap, .tilt = settings.tilt};
}

CheckAnswer<2> check(const PlanarFile&, const Grasp<2>& grasp) {
  return {force_closure(grasp), fork_wedge(grasp, grasp.loads().front().com)};
}

CheckAnswer<3> check(const SpatialFile&, const Grasp<3>& grasp) { return {force_closure(grasp)}; }

PostureOption option_of(const Question& question) {
  PostureOption option{.up = question.up};
  if (question.angle_deg) option.angle_deg = in_circle(*question.angle_deg);
  return option;
}

template <int Dim>
HoldAnswer<Dim> hold_in_posture(const FileOf<Dim>& file, const Grasp<Dim>& grasp,
                                const Question& question) {
  const HoldSettings settings = hold_settings<Dim>(file, question);
  HoldAnswer<Dim> answer{option_of(question), settings,
                         posture_at(grasp, up_of<Dim>(file, question), settings)};
  if constexpr (Dim == 2) answer.angle = angle(file, question);
  return answer;
}

/// A posture of a domain in which nothing can be held.
Posture<2> example_of(const Grasp<2>& grasp, const CurveSettings& settings) {
  const Interval domain = domain_interval(grasp, settings.domain);
  return posture_at(grasp, up_at((domain.from + domain.to) / 2),
                    {settings.force_cap, settings.objective});
}

/// Where nothing holds: the best posture of the fingers if they could press as hard as they like.
template <int Dim, class Settings>
std::optional<Posture<Dim>> best_without_max(const Grasp<Dim>& grasp, Settings settings) {
  std::vector<Contact<Dim>> contacts = grasp.contacts();
  Mechanism<Dim> mechanism = grasp.mechanism();
  bool any = false;
  const auto free = [&](double& max) {
    any = any || std::isfinite(max);
    max = std::numeric_limits<double>::infinity();
  };
  for (Contact<Dim>& contact : contacts) free(contact.max_normal);
  for (Finger<Dim>& finger : mechanism.fingers) free(finger.max_force);
  for (Drive<Dim>& drive : mechanism.drives) free(drive.max);
  if (!any) return {};
  const Grasp<Dim> strong(grasp.loads(), std::move(contacts), 1, std::move(mechanism));
  if (!has_grip(strong)) settings.objective = Objective::effort;
  const Best<Dim> best = best_posture(strong, settings);
  return best.holdable() ? std::optional<Posture<Dim>>(best.best()) : std::nullopt;
}

/// Refuses turns in space.
void refuse_turns_in_space(const Question& question) {
  for (const auto& [given, option] : {std::pair(question.tilt_from.has_value(), "tilt-from"),
                                      {question.tilt_max_deg.has_value(), "tilt-max"},
                                      {question.orientation.has_value(), "orientation"}})
    if (given) throw Misfit(option, "is for space,", 2);
}

/// And how to search there, where the plane needs no search.
void refuse_spatial(const Question& question) {
  for (const auto& [given, option] :
       {std::pair(question.gap.has_value(), "gap"), {question.max_holds.has_value(), "max-holds"}})
    if (given) throw Misfit(option, "is for space,", 2);
  refuse_turns_in_space(question);
}

TurnTaken<2> taken(const Grasp<2>& grasp, double from, double to, const CurveSettings& settings) {
  TurnTaken<2> result;
  std::vector<TurnPeak<2>> ways = ways_round(grasp, from, to, settings);
  if (ways.empty()) {
    result.straight = turn_peak(grasp, from, 0, settings);
    return result;
  }
  const bool is_other_first = ways.size() == 2 && std::abs(ways[1].angle) < std::abs(ways[0].angle);
  if (is_other_first) std::swap(ways[0], ways[1]);
  result.straight = std::move(ways[0]);
  if (ways.size() == 2) result.other = std::move(ways[1]);
  return result;
}

TurnTaken<3> straight_turn(const Grasp<3>& grasp, const Eigen::Quaterniond& from,
                           const Posture<3>& then, const TurnSettings& settings) {
  return {turn_to(from, then.up), turn_peak(grasp, from, then.up, settings)};
}

TurnTaken<3> taken(const Grasp<3>& grasp, const Eigen::Quaterniond& from, const Posture<3>& now,
                   const Posture<3>& then, const TurnSettings& settings) {
  TurnTaken<3> result = straight_turn(grasp, from, then, settings);
  if (now.holdable() && then.holdable())
    result.way = least_peak_way(grasp, now.up, then.up, settings);
  return result;
}

/// The least that a way to the posture needs.
double peak(const TurnTaken<2>& taken) {
  return taken.other ? std::min(taken.straight.peak, taken.other->peak) : taken.straight.peak;
}
double peak(const TurnTaken<3>& taken) {
  return taken.way ? std::min(taken.straight.peak, taken.way->peak) : taken.straight.peak;
}

BestAnswer<2> best(const PlanarFile& file, const Grasp<2>& grasp, const Question& question) {
  refuse_spatial(question);
  const CurveSettings settings = curve_settings(file, question);
  BestAnswer<2> answer{settings, best_posture(grasp, settings)};
  if (file.angle)
    answer.now = posture_at(grasp, up_at(*file.angle), {settings.force_cap, settings.objective});
  if (answer.best.holdable() && question.with_turn) {
    const double from = file.angle.value_or(0);
    const HoldSettings of_hold{settings.force_cap, settings.objective};
    const Posture<2> start = answer.now ? *answer.now : posture_at(grasp, up_at(from), of_hold);
    answer.turn = taken(grasp, from, answer.best.best().optimum.angle, settings);
    if (start.holdable() && !(peak(*answer.turn) <= start.value() * (1 + same_peak)))
      answer.within_reach = best_reachable(grasp, from, settings);
  }
  if (!answer.best.holdable()) {
    answer.unholdable = example_of(grasp, settings);
    answer.without_max = best_without_max(grasp, settings);
  }
  return answer;
}

/// Of objectives that differ by less, in parts, the present posture wins, then the least turn.
constexpr double tie = 1e-6;

/// What a tie with the best may need, as far as the wanted gap allows.
double most_of_ties(const Best<3>& best, double gap) {
  const double value = best.best().value();
  const double most = value * (1 + tie);
  if (best.status != Status::optimal) return most;
  return std::clamp(best.lower_bound / (1 - gap), value, most);
}

/// How sure the first of the minima is.
void update_gap(Best<3>& best, double gap) {
  const double value = best.best().value();
  best.lower_bound = std::min(best.lower_bound, value);
  best.relative_gap = value > 0 ? (value - best.lower_bound) / value : 0;
  best.status = best.relative_gap <= gap ? Status::optimal : Status::gap;
}

/// Puts a posture before the minima.
void put_first(Best<3>& best, const Posture<3>& posture, double gap) {
  best.minima.insert(best.minima.begin(), {posture});
  if (best.pinched) ++*best.pinched;
  update_gap(best, gap);
}

/// The posture in which it is held now counts as found: it may be all that can be held. It wins
/// ties, else the least turn from it does.
void name_least_turn(Best<3>& best, const Grasp<3>& grasp, const SpatialSettings& settings,
                     const Posture<3>& now) {
  const bool in_domain = !settings.tilt || now.up.dot(settings.tilt->from.normalized()) >=
                                               std::cos(settings.tilt->most);
  if (now.holdable() && in_domain &&
      (!best.holdable() || now.value() <= most_of_ties(best, settings.gap))) {
    put_first(best, now, settings.gap);
    if (now.manner == Manner::pinched && is_interior(grasp, settings, now.up)) best.pinched = 0;
    return;
  }
  if (!best.holdable()) return;
  const double most = most_of_ties(best, settings.gap);
  std::size_t nearest = 0;
  for (std::size_t k = 1; k < best.minima.size(); ++k)
    if (best.minima[k].value() <= most &&
        now.up.dot(best.minima[k].up) > now.up.dot(best.minima[nearest].up))
      nearest = k;
  const Minimum<3>& known = best.minima[nearest];
  const auto up = nearest_tie(grasp, settings, now.up, known.up, best.best().value(), most);
  const Posture<3> posture =
      up ? posture_at(grasp, *up, {settings.force_cap, settings.objective}) : Posture<3>{};
  if (up && posture.value() <= most) {
    put_first(best, posture, settings.gap);
    if (posture.manner == Manner::pinched && is_interior(grasp, settings, posture.up))
      best.pinched = 0;
    return;
  }
  const auto first = best.minima.begin(), chosen = first + static_cast<std::ptrdiff_t>(nearest);
  std::rotate(first, chosen, chosen + 1);
  update_gap(best, settings.gap);
  if (best.pinched && *best.pinched <= nearest)
    best.pinched = *best.pinched == nearest ? 0 : *best.pinched + 1;
}

/// Refuses what is for the plane.
void refuse_planar(const Question& question) {
  if (question.domain.value_or(Domain::all) == Domain::pinching_up)
    throw Misfit("domain", "pinching-up is for the plane,", 3);
}

BestAnswer<3> best(const SpatialFile& file, const Grasp<3>& grasp, const Question& question) {
  refuse_planar(question);
  const SpatialSettings settings = spatial_settings(file, question, grasp.is_general());
  BestAnswer<3> answer{settings, best_posture(grasp, settings)};
  answer.orientation = present_orientation(file, question);
  const Vector<3> now = answer.orientation.conjugate() * Vector<3>::UnitZ();
  if (question.orientation || file.up)
    answer.now = posture_at(grasp, now, {settings.force_cap, settings.objective});
  if (answer.now) name_least_turn(answer.best, grasp, settings, *answer.now);
  if (answer.best.holdable() && question.with_turn) {
    const TurnSettings of_turn = turn_settings(settings);
    const Posture<3> start =
        answer.now ? *answer.now : posture_at(grasp, now, {settings.force_cap, settings.objective});
    const Posture<3>& then = answer.best.best();
    answer.turn = taken(grasp, answer.orientation, start, then, of_turn);
    const double most = start.value() / (1 - of_turn.gap);
    if (start.holdable() && !(peak(*answer.turn) <= most))
      answer.within_reach = best_reachable(grasp, now, then.up, of_turn);
  }
  if (answer.best.status == Status::unholdable) {
    answer.unholdable = posture_at(grasp, settings.tilt ? settings.tilt->from : now,
                                   {settings.force_cap, settings.objective});
    answer.without_max = best_without_max(grasp, settings);
  }
  return answer;
}

TurnAnswer<2> turn(const PlanarFile& file, const Grasp<2>& grasp, const Question& question) {
  if (!posture_given(question)) throw Misfit("to", "is needed: a posture to turn to, for", 2);
  refuse_spatial(question);
  const CurveSettings settings = curve_settings(file, question);
  const Vector<2> up = given_up(file, question);
  const double from = file.angle.value_or(0);
  const double to = question.angle_deg ? radians(*question.angle_deg) : angle_of(up);
  const HoldSettings of_hold{settings.force_cap, settings.objective};
  return {option_of(question), settings, posture_at(grasp, up_at(from), of_hold),
          posture_at(grasp, up, of_hold), taken(grasp, from, to, settings)};
}

TurnAnswer<3> turn(const SpatialFile& file, const Grasp<3>& grasp, const Question& question) {
  if (!posture_given(question)) throw Misfit("to", "is needed: a posture to turn to, for", 3);
  refuse_planar(question);
  TurnSettings settings{.objective = question.objective.value_or(file.objective),
                        .force_cap = question.force_cap,
                        .tilt = tilt_of(file, question)};
  settings.gap = question.gap.value_or(settings.gap);
  settings.max_holds = question.max_holds.value_or(settings.max_holds);
  const Eigen::Quaterniond orientation = present_orientation(file, question);
  const HoldSettings of_hold{settings.force_cap, settings.objective};
  const Vector<3> from = orientation.conjugate() * Vector<3>::UnitZ();
  TurnAnswer<3> answer{option_of(question),
                       settings,
                       orientation,
                       posture_at(grasp, from, of_hold),
                       posture_at(grasp, given_up(file, question), of_hold),
                       {}};
  answer.taken = question.with_turn ? taken(grasp, orientation, answer.now, answer.then, settings)
                                    : straight_turn(grasp, orientation, answer.then, settings);
  return answer;
}

CurveAnswer curve(const PlanarFile& file, const Grasp<2>& grasp, const Question& question) {
  const CurveSettings settings = curve_settings(file, question);
  CurveAnswer answer{settings, posture_curve(grasp, settings), {}};
  for (const Optimum& optimum : answer.curve.optima)
    answer.optima.push_back(minimum_at(grasp, optimum, settings));
  if (answer.curve.holdable.empty()) answer.unholdable = example_of(grasp, settings);
  return answer;
}

std::optional<Vector<2>> best_up(const PlanarFile& file, const Grasp<2>& grasp,
                                 const Question& question) {
  CurveSettings settings = curve_settings(file, question);
  // The curve of the effort knows no limits of drives.
  if (grasp.is_general()) settings.objective = Objective::grip;
  if (settings.objective == Objective::grip && !has_grip<2>(grasp)) return {};
  const Best<2> best = best_posture(grasp, settings);
  return best.holdable() ? std::optional(best.best().up) : std::nullopt;
}

std::optional<Vector<3>> best_up(const SpatialFile& file, const Grasp<3>& grasp,
                                 const Question& question) {
  SpatialSettings settings = spatial_settings(file, question, grasp.is_general());
  settings.starts = 0;
  Best<3> best = best_posture(grasp, settings);
  if (file.up)
    name_least_turn(best, grasp, settings,
                    posture_at(grasp, *file.up, {settings.force_cap, settings.objective}));
  return best.holdable() ? std::optional(best.best().up) : std::nullopt;
}

template <int Dim>
using NamedUps = std::vector<std::pair<std::string, Vector<Dim>>>;

enum class Which { first, all };

/// The posture given; else that of the file and the best one, as far as they are wanted.
template <int Dim>
NamedUps<Dim> postures(const FileOf<Dim>& file, const Grasp<Dim>& grasp, const Question& question,
                       Which which) {
  if (posture_given(question)) return {{"given", given_up(file, question)}};
  NamedUps<Dim> list;
  if (const auto now = present_up(file)) list.emplace_back("now", *now);
  if (list.empty() || which == Which::all)
    if (const auto up = best_up(file, grasp, question)) list.emplace_back("best", *up);
  if (list.empty()) list.emplace_back("upright", upright<Dim>());
  return list;
}

template <int Dim>
CapacityAnswer<Dim> capacities(const FileOf<Dim>& file, const Grasp<Dim>& grasp,
                               const Question& question) {
  const HoldSettings settings{.force_cap = question.force_cap};
  if (question.grip && !has_grip(grasp))
    throw Misfit("grip", "is nothing where fingers have no closing direction, as in", 0);
  CapacityAnswer<Dim> answer{
      option_of(question), question.force_cap, question.safety, question.grip, {}};
  for (const auto& [name, up] : postures(file, grasp, question, Which::all))
    for (std::size_t k = 0; k < grasp.loads().size(); ++k) {
      const Load<Dim>& load = grasp.loads()[k];
      const Grasp<Dim> one(load, grasp.contacts(), 1, grasp.mechanism());
      const ShakeSettings shaken{.force_cap = question.force_cap, .most_grip = question.grip};
      answer.capacities.push_back({name, up, k,
                                   capacity(grasp, load, up, question.safety, settings),
                                   shake(one, up, shaken), tilting(one, up, shaken)});
    }
  return answer;
}

ShakeSettings sturdy_settings(const Question& question) {
  ShakeSettings settings{.force_cap = question.force_cap};
  settings.gap = question.gap.value_or(settings.gap);
  settings.max_holds = question.max_holds.value_or(settings.max_holds);
  return settings;
}

SturdyAnswer<2> sturdiest(const PlanarFile& file, const Grasp<2>& grasp, const Question& question) {
  refuse_turns_in_space(question);
  SturdyAnswer<2> answer{sturdy_settings(question), question.domain.value_or(file.domain)};
  answer.now_up = up_at(file.angle.value_or(0));
  answer.found = sturdiest_posture(grasp, answer.domain, answer.settings, answer.now_up);
  if (file.angle) answer.now = shake<2>(grasp, answer.now_up, answer.settings);
  return answer;
}

SturdyAnswer<3> sturdiest(const SpatialFile& file, const Grasp<3>& grasp,
                          const Question& question) {
  refuse_planar(question);
  SturdyAnswer<3> answer{.settings = sturdy_settings(question), .tilt = tilt_of(file, question)};
  answer.orientation = present_orientation(file, question);
  answer.now_up = answer.orientation.conjugate() * Vector<3>::UnitZ();
  answer.found = sturdiest_posture(grasp, answer.tilt, answer.settings, answer.now_up);
  if (question.orientation || file.up) answer.now = shake<3>(grasp, answer.now_up, answer.settings);
  return answer;
}

template <int Dim>
AnswerTo<Dim> answer_to(const FileOf<Dim>& file, const Grasp<Dim>& grasp,
                        const Question& question) {
  switch (question.command) {
    case Command::check:
      return {check(file, grasp)};
    case Command::hold:
      return {hold_in_posture(file, grasp, question)};
    case Command::best:
      return {best(file, grasp, question)};
    case Command::turn:
      return {turn(file, grasp, question)};
    case Command::curve:
      if constexpr (Dim == 2)
        return {curve(file, grasp, question)};
      else
        throw Misfit("curve", "is for the plane,", 3);
    case Command::capacity:
      return {capacities(file, grasp, question)};
    case Command::sturdiest:
      return {sturdiest(file, grasp, question)};
  }
  throw std::logic_error("a command without an answer");
}

template <int Dim>
NamedPosture<Dim> first_posture(const FileOf<Dim>& file, const Grasp<Dim>& grasp,
                                const Question& question) {
  const auto [name, up] = postures(file, grasp, question, Which::first).front();
  return {name, posture_at(grasp, up, hold_settings<Dim>(file, question))};
}

}  // namespace

TurnTaken<2> turn_taken(const Grasp<2>& grasp, double from, double to,
                        const CurveSettings& settings) {
  return taken(grasp, from, to, settings);
}

TurnTaken<3> turn_taken(const Grasp<3>& grasp, const Eigen::Quaterniond& from,
                        const Posture<3>& now, const Posture<3>& then,
                        const TurnSettings& settings) {
  return taken(grasp, from, now, then, settings);
}

AnswerTo<2> ask(const PlanarFile& file, const Grasp<2>& grasp, const Question& question) {
  return answer_to<2>(file, grasp, question);
}

AnswerTo<3> ask(const SpatialFile& file, const Grasp<3>& grasp, const Question& question) {
  return answer_to<3>(file, grasp, question);
}

template <int Dim>
bool holdable(const AnswerTo<Dim>& answer) {
  return std::visit(
      Overloaded{[](const CheckAnswer<Dim>&) { return true; },
                 [](const HoldAnswer<Dim>& hold) { return hold.posture.holdable(); },
                 [](const BestAnswer<Dim>& best) { return best.best.holdable(); },
                 [](const TurnAnswer<Dim>& turn) { return std::isfinite(peak(turn.taken)); },
                 [](const CurveAnswer& curve) { return !curve.curve.holdable.empty(); },
                 [](const CapacityAnswer<Dim>& capacity) {
                   std::map<std::string, bool> held;  // in which posture against all loads
                   for (const CapacityAt<Dim>& each : capacity.capacities) {
                     bool& all = held.try_emplace(each.posture, true).first->second;
                     all = all && each.capacity.friction.factor <= 1;
                   }
                   return std::any_of(held.begin(), held.end(),
                                      [](const auto& posture) { return posture.second; });
                 },
                 [](const SturdyAnswer<Dim>& sturdy) { return !sturdy.found.shakes.empty(); }},
      answer.of);
}

template <int Dim>
bool proven(const AnswerTo<Dim>& answer) {
  return std::visit(
      Overloaded{
          [](const CheckAnswer<Dim>&) { return true; },
          [](const HoldAnswer<Dim>& hold) { return hold.posture.hold().proven; },
          [](const BestAnswer<2>& best) { return best.best.proof.curve.undecided.empty(); },
          [](const BestAnswer<3>& best) { return best.best.status != Status::gap; },
          [](const TurnAnswer<2>&) { return true; },
          [](const TurnAnswer<3>& turn) {
            const std::optional<Way>& way = turn.taken.way;
            return !way || way->status != Status::gap;
          },
          [](const CurveAnswer& curve) { return curve.curve.undecided.empty(); },
          [](const CapacityAnswer<Dim>& capacity) {
            const auto open = [](const CapacityAt<Dim>& each) {
              const LeastFriction<Dim>& friction = each.capacity.friction;
              return friction.factor > 1 && !(friction.bound >= 1);
            };
            return std::none_of(capacity.capacities.begin(), capacity.capacities.end(), open);
          },
          [](const SturdyAnswer<Dim>& sturdy) { return sturdy.found.status != Status::gap; }},
      answer.of);
}

template bool proven(const AnswerTo<2>&);
template bool proven(const AnswerTo<3>&);
template bool holdable(const AnswerTo<2>&);
template bool holdable(const AnswerTo<3>&);

NamedPosture<2> posture_to_show(const PlanarFile& file, const Grasp<2>& grasp,
                                const Question& question) {
  return first_posture<2>(file, grasp, question);
}

NamedPosture<3> posture_to_show(const SpatialFile& file, const Grasp<3>& grasp,
                                const Question& question) {
  return first_posture<3>(file, grasp, question);
}

}  // namespace poise
