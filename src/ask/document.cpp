#include "ask/document.hpp"

#include <algorithm>
#include <cmath>

#include "files/degrees.hpp"
#include "files/grasp_writer.hpp"
#include "files/json_text.hpp"
#include "files/json_value.hpp"
#include "poise/grip.hpp"
#include "poise/turn.hpp"

namespace poise {
namespace {

/// Infinite ones are null.
std::optional<double> finite(double number) {
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

/// Told only where it is not.
std::optional<bool> where_false(bool proven) {
  return proven ? std::nullopt : std::optional(false);
}

/// None are left out.
std::optional<std::vector<double>> some(const SmallVector<double, 4>& rates) {
  if (rates.empty()) return {};
  return std::vector<double>(rates.begin(), rates.end());
}

template <int Dim>
std::vector<ContactClaim<Dim>> contact_claims(const Hand<Dim>& hand, const Hold<Dim>& hold) {
  std::vector<ContactClaim<Dim>> claims(hold.forces.size());
  auto point = hold.pad_forces.begin();
  for (std::size_t i = 0; i < claims.size(); ++i) {
    const Contact<Dim>& contact = hand.contacts()[i];
    const ContactForce<Dim>& force = hold.forces[i];
    claims[i] = {.finger = contact.finger,
                 .friction_used = force.friction_used,
                 .normal_force = force.normal,
                 .force = force_vector(contact, force),
                 .state = force.state,
                 .limit = force.limit};
    if constexpr (Dim == 2) {
      claims[i].tangential_force = force.tangential;
    } else {
      claims[i].tangential_force = force.tangential.norm();
      if (contact.torsion > 0 || contact.pad) claims[i].torsion_moment = force.torsion_moment;
      if (!contact.pad) continue;
      claims[i].center_of_pressure = contact.position + force.center_of_pressure;
      const auto last = point + static_cast<std::ptrdiff_t>(contact.pad->points.size());
      claims[i].point_forces.emplace(point, last);
      point = last;
    }
  }
  return claims;
}

template <int Dim>
void add_drives(HoldClaim<Dim>& claim, const Hand<Dim>& hand, const Hold<Dim>& hold) {
  if (!has_grip(hand)) return;
  claim.grip = grip(hand, hold);
  const std::vector<Drive<Dim>> drives = hand.drives();
  const std::vector<DriveEffort> efforts = drive_efforts(hand, hold);
  for (std::size_t a = 0; a < drives.size(); ++a) {
    const std::optional<double> max = finite(drives[a].max);
    claim.drives.push_back({drives[a].name, efforts[a].effort, max,
                            max ? std::optional(efforts[a].part_of_max) : std::nullopt});
  }
}

template <int Dim>
HoldClaim<Dim> hold_claim(const Hand<Dim>& hand, double weight, const Vector<Dim>& up,
                          const Hold<Dim>& hold, Manner manner) {
  HoldClaim<Dim> claim;
  claim.holdable = hold.holdable;
  claim.up = up;
  if constexpr (Dim == 2) claim.angle_deg = degrees(angle_of(up));
  claim.objective = hold.objective;
  claim.dual = hold.dual;
  claim.rates = some(hold.rates);
  claim.lower_bound = hold.lower_bound;
  if (!hold.holdable) {
    claim.proven = where_false(hold.proven);
    claim.reason = reason(hand, hold);
    return claim;
  }
  claim.effort = hold.effort;
  claim.force_norm = std::sqrt(hold.effort);
  claim.residual = hold.residual;
  claim.manner = manner;
  claim.all_loaded = all_loaded(hand, hold, weight);
  const std::vector<FingerForce<Dim>> fingers = finger_forces(hand, hold);
  for (std::size_t k = 0; k < fingers.size(); ++k)
    claim.fingers.push_back(
        {hand.fingers()[k], fingers[k].normal,
         hand.closing(k).isZero(0) ? std::nullopt : std::optional(fingers[k].pressing),
         fingers[k].force});
  add_drives(claim, hand, hold);
  claim.contacts = contact_claims(hand, hold);
  return claim;
}

/// Of a posture against one load.
template <int Dim>
HoldClaim<Dim> hold_claim(const Hand<Dim>& hand, double weight, const Posture<Dim>& posture) {
  return hold_claim(hand, weight, posture.up, posture.hold(), posture.manner);
}

template <int Dim>
HoldClaim<Dim> hold_claim(const Grasp<Dim>& grasp, const Posture<Dim>& posture) {
  const std::vector<Load<Dim>>& loads = grasp.loads();
  const auto size = [&](std::size_t k) { return loads[k].size(grasp.length()); };
  HoldClaim<Dim> claim = hold_claim(grasp, size(posture.decides), posture);
  if (loads.size() == 1) return claim;
  claim.load = posture.decides;
  // That nothing holds is told in terms of the effort.
  const auto is_grip = [](const Hold<Dim>& hold) { return hold.objective == Objective::grip; };
  auto& values = std::any_of(posture.holds.begin(), posture.holds.end(), is_grip)
                     ? claim.load_grips
                     : claim.load_efforts;
  values.emplace();
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const Hold<Dim>& hold = posture.holds[k];
    values->push_back(hold.holdable ? finite(hold.value()) : std::nullopt);
    claim.load_holds.emplace_back();
    if (k != posture.decides && hold.holdable)
      claim.load_holds.back() = hold_claim<Dim>(grasp, size(k), posture.up, hold,
                                                manner<Dim>(grasp, loads[k], posture.up, hold));
  }
  return claim;
}

HoldClaim<3> minimum_claim(const Grasp<3>& grasp, const Minimum<3>& minimum) {
  return hold_claim<3>(grasp, minimum);
}

OptimumClaim minimum_claim(const Grasp<2>& grasp, const Minimum<2>& minimum) {
  const Optimum& optimum = minimum.optimum;
  OptimumClaim claim{hold_claim<2>(grasp, minimum), optimum.kind};
  claim.angle_deg = degrees(optimum.angle);
  if (optimum.from != optimum.to) {
    claim.from_deg = degrees(optimum.from);
    claim.to_deg = degrees(optimum.to);
  }
  if (minimum.two_slipping) claim.edges_meet = minimum.edges_meet;
  return claim;
}

template <int Dim>
std::optional<MinimumClaim<Dim>> minimum_claim(const Grasp<Dim>& grasp,
                                               const Minimum<Dim>* minimum) {
  if (!minimum) return {};
  return minimum_claim(grasp, *minimum);
}

std::vector<ArcClaim> arc_claims(const PostureCurve& curve) {
  std::vector<ArcClaim> claims;
  for (const Arc& arc : curve.arcs) {
    ArcClaim claim{.from = arc.from, .to = arc.to};
    if (!curve.loads.empty()) claim.load = arc.load;
    if (arc.rates) {
      claim.F = {arc.value.c0, arc.value.cos1, arc.value.sin1};
      claim.rates = *arc.rates;
      claim.forces = arc.forces;
    } else {
      claim.V = arc.value;
    }
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Harmonic1& y = arc.y[static_cast<std::size_t>(k)];
      claim.y.c0[k] = y.c0;
      claim.y.cos1[k] = y.cos1;
      claim.y.sin1[k] = y.sin1;
    }
    const auto contacts = curve.states.size() / curve.arcs.size();
    const auto first = curve.states.begin() + static_cast<std::ptrdiff_t>(arc.first_state);
    claim.states.assign(first, first + static_cast<std::ptrdiff_t>(contacts));
    claims.push_back(std::move(claim));
  }
  return claims;
}

std::vector<UnholdableClaim> unholdable_claims(const PostureCurve& curve) {
  std::vector<UnholdableClaim> claims;
  for (const UnholdableArc& arc : curve.unholdable_arcs) {
    claims.push_back({arc.from, arc.to, arc.y, arc.rates, {}});
    if (!curve.loads.empty()) claims.back().load = arc.load;
  }
  return claims;
}

std::optional<std::vector<LoadCurveClaim>> load_curve_claims(const PostureCurve& curve) {
  if (curve.loads.empty()) return {};
  std::vector<LoadCurveClaim> claims;
  for (const PostureCurve& each : curve.loads) claims.push_back({arc_claims(each), each.holdable});
  return claims;
}

template <int Dim>
TurnPostureClaim<Dim> turn_posture_claim(const Grasp<Dim>& grasp, const Posture<Dim>& posture,
                                         double turn) {
  return {hold_claim(grasp, posture), degrees(turn)};
}

template <int Dim>
PeakClaim<Dim> peak_claim(const Grasp<Dim>& grasp, const TurnPeak<Dim>& peak) {
  PeakClaim<Dim> claim{.turn_deg = degrees(peak.angle)};
  for (const UnholdableStretch<Dim>& stretch : peak.unholdable)
    claim.unholdable.push_back({degrees(stretch.from), degrees(stretch.to),
                                turn_posture_claim(grasp, stretch.posture, stretch.at)});
  claim.peak = finite(peak.peak);
  claim.lower_bound = finite(peak.lower_bound);
  if (claim.peak) claim.peak_at = turn_posture_claim(grasp, peak.posture, peak.at);
  return claim;
}

RotationClaim rotation_claim(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }

/// Of a way from the present orientation: the one that each of its postures leads to.
std::vector<RotationClaim> orientation_claims(const Eigen::Quaterniond& start,
                                              const std::vector<Vector<3>>& ups) {
  std::vector<RotationClaim> claims;
  Eigen::Quaterniond orientation = start;
  for (const Vector<3>& up : ups) {
    orientation = turn_to(orientation, up).orientation;
    claims.push_back(rotation_claim(orientation));
  }
  return claims;
}

WayClaim way_claim(const Eigen::Quaterniond& start, const Way& way) {
  WayClaim claim{.status = way.status,
                 .peak = finite(way.peak),
                 .lower_bound = finite(way.lower_bound),
                 .orientations = orientation_claims(start, way.ups),
                 .holds = way.holds};
  for (const WallPart& part : way.wall) claim.wall.push_back({part.up, part.cut});
  return claim;
}

TurnClaim<2> turn_claim(const Grasp<2>& grasp, const TurnTaken<2>& taken) {
  TurnClaim<2> claim{peak_claim(grasp, taken.straight)};
  if (taken.other) claim.other_way = peak_claim(grasp, *taken.other);
  return claim;
}

TurnClaim<3> turn_claim(const Grasp<3>& grasp, const TurnTaken<3>& taken,
                        const Eigen::Quaterniond& start) {
  TurnClaim<3> claim{peak_claim(grasp, taken.straight)};
  claim.rotation = rotation_claim(taken.turn.rotation);
  claim.rotation.angle_deg = degrees(taken.turn.angle);
  claim.orientation = rotation_claim(taken.turn.orientation);
  if (taken.way) claim.way = way_claim(start, *taken.way);
  return claim;
}

OptionsClaim options_claim(const CurveSettings& settings) {
  return {.domain = settings.domain,
          .present_deg = degrees(settings.present),
          .force_cap = settings.force_cap,
          .objective = settings.objective};
}

void add_proof(BestDocument<2>& claim, const Grasp<2>& grasp, const BestAnswer<2>& answer) {
  const Proof<2>& proof = answer.best.proof;
  claim.options = options_claim(answer.settings);
  if (answer.turn) claim.turn = turn_claim(grasp, *answer.turn);
  if (const auto& near = answer.within_reach)
    claim.without_pressing_harder = {turn_posture_claim(grasp, near->posture, near->angle),
                                     degrees(near->least_angle), degrees(near->most_angle)};
  if (answer.best.holdable()) claim.lower_bound = answer.best.lower_bound;
  if (proof.worst) claim.worst = minimum_claim(grasp, *proof.worst);
  claim.arcs = arc_claims(proof.curve);
  claim.unholdable_arcs = unholdable_claims(proof.curve);
  claim.holdable_arcs_deg = proof.curve.holdable;
  claim.load_curves = load_curve_claims(proof.curve);
}

void add_proof(BestDocument<3>& claim, const Grasp<3>& grasp, const BestAnswer<3>& answer) {
  const SpatialSettings& settings = answer.settings;
  claim.options = {.domain = Domain::all,
                   .force_cap = settings.force_cap,
                   .objective = settings.objective,
                   .gap = settings.gap,
                   .max_holds = settings.max_holds,
                   .tilt = settings.tilt,
                   .orientation = rotation_claim(answer.orientation)};
  if (answer.best.status != Status::unholdable) claim.lower_bound = answer.best.lower_bound;
  claim.holds = answer.best.proof.holds;
  claim.cuts = answer.best.proof.cuts;
  if (answer.turn) claim.turn = turn_claim(grasp, *answer.turn, answer.orientation);
  if (const auto& near = answer.within_reach)
    claim.without_pressing_harder = {hold_claim(grasp, near->posture),
                                     near->way.status,
                                     near->lower_bound,
                                     near->way.peak,
                                     orientation_claims(answer.orientation, near->way.ups),
                                     near->way.holds};
}

template <int Dim>
WeightClaim<Dim> weight_claim(const Hand<Dim>& hand, const Load<Dim>& load,
                              const WeightRange<Dim>& range) {
  const WeightEnd<Dim>& least = range.least;
  const WeightEnd<Dim>& greatest = range.greatest;
  WeightClaim<Dim> claim{.given = load.weight,
                         .holdable = range.holdable,
                         .any = range.holdable && std::isinf(greatest.weight),
                         .proven = where_false(range.proven),
                         .greatest_bound = finite(greatest.bound),
                         .greatest_dual = greatest.dual,
                         .greatest_rates = some(greatest.rates),
                         .least_bound = least.bound,
                         .least_dual = least.dual,
                         .least_rates = some(least.rates)};
  if (!range.holdable) return claim;
  claim.greatest = finite(greatest.weight);
  claim.least = least.weight;
  const auto size = [&](Load<Dim> other, double weight) {
    other.weight = weight;
    return other.size(hand.length());
  };
  // Where any weight is held, a fixed wrench is nothing near it; unless it falls freely.
  Load<Dim> alone = load;
  alone.fixed.setZero();
  if (!(size(alone, 1) > 0)) alone = load;
  claim.greatest_hold = hold_claim(
      hand,
      claim.greatest ? size(load, *claim.greatest) : size(alone, load.weight > 0 ? load.weight : 1),
      greatest.posture);
  if (least.weight > 0)
    claim.least_hold = hold_claim(hand, size(load, least.weight), least.posture);
  for (std::size_t i = 0; i < range.deciding.size(); ++i)
    claim.contacts.push_back({range.deciding[i], hand.contacts()[i].finger});
  const std::vector<Drive<Dim>> drives = hand.drives();
  for (std::size_t a = 0; a < range.deciding_drives.size(); ++a)
    claim.drives.push_back({drives[a].name, range.deciding_drives[a]});
  return claim;
}

template <int Dim>
FrictionClaim<Dim> friction_claim(const Hand<Dim>& hand, const Load<Dim>& load,
                                  const LeastFriction<Dim>& friction) {
  FrictionClaim<Dim> claim{finite(friction.factor), friction.bound, where_false(friction.proven),
                           friction.dual, some(friction.rates)};
  if (claim.factor) claim.hold = hold_claim(hand, load.size(hand.length()), friction.posture);
  return claim;
}

// How claims become JSON.

template <class T>
Json json_of(T& value);

class Writer {
 public:
  Json json = Json::object();

  void operator()(const char* key, auto& value, auto&&... rest) {
    json[key] = json_of(value);
    if constexpr (sizeof...(rest) > 0) (*this)(rest...);
  }
  void maybe(const char* key, auto& value, auto&&... rest) {
    if (value) json[key] = json_of(*value);
    if constexpr (sizeof...(rest) > 0) maybe(rest...);
  }
  void degrees(const char* key, double radians, auto&&... rest) {
    json[key] = poise::degrees(radians);
    if constexpr (sizeof...(rest) > 0) degrees(rest...);
  }
};

template <class T>
Json json_of(T& value) {
  if constexpr (std::is_enum_v<T>) {
    return words_of(value)[static_cast<std::size_t>(value)];
  } else if constexpr (std::is_integral_v<T>) {
    return value;
  } else if constexpr (std::is_same_v<T, Interval>) {
    return {degrees(value.from), degrees(value.to)};
  } else if constexpr (requires { json_value(value); }) {
    return json_value(value);
  } else if constexpr (requires { value.has_value(); }) {
    return value ? json_of(*value) : Json();
  } else if constexpr (requires { value.begin(); }) {
    Json list = Json::array();
    for (auto& part : value) list.push_back(json_of(part));
    return list;
  } else {
    Writer writer;
    if constexpr (requires { value.fields(writer); })
      value.fields(writer);
    else
      fields(value, writer);
    return std::move(writer.json);
  }
}

Json head(const char* command) { return {{"poise_result", 1}, {"command", command}}; }

/// A hold without its proof and its contacts; null stays null.
template <class Claim>
Json brief(Claim claim) {
  Json json = json_of(claim);
  if (json.is_null()) return json;
  for (const char* const key : {"dual", "y", "rates", "residual", "drives", "contacts"})
    json.erase(key);
  return json;
}

/// With the finger first.
template <int Dim>
Json contact_value(const Contact<Dim>& contact) {
  Json result = {{"finger", contact.finger}};
  for_each_contact_field<Dim>(
      [&](const char* name, auto member) { result[name] = json_value(contact.*member); });
  return result;
}

template <int Dim>
Json load_value(const Load<Dim>& load) {
  Json result = Json::object();
  if (!load.name.empty()) result["name"] = load.name;
  for_each_load_field<Dim>(
      [&](const char* name, auto member) { result[name] = json_value(load.*member); });
  return result;
}

void add_posture(Json& result, const PlanarFile& file) {
  result["angle_deg"] = file.angle ? Json(degrees(*file.angle)) : Json();
  result["domain"] = words_of(file.domain)[static_cast<std::size_t>(file.domain)];
}

std::optional<std::vector<double>> some_above_zero(const SmallVector<double, 4>& rates) {
  const bool any = std::any_of(rates.begin(), rates.end(), [](double rate) { return rate > 0; });
  return any ? some(rates) : std::nullopt;
}

/// Of a Shake or a Tilting of one load.
template <int Dim, class Found>
ShakeProofClaim<Dim> proof_claim(const Found& found) {
  ShakeProofClaim<Dim> claim{.y = found.cut.y, .rates = some_above_zero(found.cut.rates)};
  if (!found.held.empty()) claim.held = found.held.front();  // else nothing is shaken
  return claim;
}

template <int Dim>
ShakeClaim<Dim> shake_claim(const Shake<Dim>& found) {
  ShakeClaim<Dim> claim{.acceleration = finite(found.acceleration),
                        .bound = finite(found.bound),
                        .proven = where_false(found.proven),
                        .proof = proof_claim<Dim>(found)};
  if (claim.bound.value_or(0) > 0) claim.direction = found.direction;
  return claim;
}

template <int Dim>
TiltClaim<Dim> tilt_claim(const Tilting<Dim>& found) {
  TiltClaim<Dim> claim{
      .bound = found.bound, .proven = where_false(found.proven), .proof = proof_claim<Dim>(found)};
  if (!found.cut.y.isZero(0)) claim.weakest = found.up;
  return claim;
}

void add_posture(Json& result, const SpatialFile& file) {
  result["up"] = file.up ? json_value(*file.up) : Json();
  result["tilt"] = file.tilt ? tilt_value(*file.tilt) : Json();
}

}  // namespace

template <int Dim>
HoldDocument<Dim> claims_of(const Grasp<Dim>& grasp, const HoldAnswer<Dim>& answer) {
  HoldDocument<Dim> claim{hold_claim(grasp, answer.posture)};
  claim.options = {.force_cap = answer.settings.force_cap,
                   .objective = answer.settings.objective,
                   .angle_deg = answer.option.angle_deg};
  if (!answer.option.up.empty()) claim.options.up = answer.option.up;
  if (answer.angle) claim.angle_deg = degrees(*answer.angle);
  if (answer.option.angle_deg) claim.angle_deg = *answer.option.angle_deg;  // to the last digit
  return claim;
}

template <int Dim>
BestDocument<Dim> claims_of(const Grasp<Dim>& grasp, const BestAnswer<Dim>& answer) {
  const Best<Dim>& best = answer.best;
  BestDocument<Dim> claim;
  claim.status = best.status;
  if (best.holdable()) {
    claim.best = minimum_claim(grasp, best.best());
    claim.relative_gap = best.relative_gap;
  }
  claim.best_pinched = minimum_claim(grasp, best.best_pinched());
  for (const Minimum<Dim>& minimum : best.minima)
    claim.minima.push_back(minimum_claim(grasp, minimum));
  add_proof(claim, grasp, answer);
  return claim;
}

TurnDocument<2> claims_of(const Grasp<2>& grasp, const TurnAnswer<2>& answer) {
  TurnDocument<2> claim{options_claim(answer.settings), hold_claim(grasp, answer.now),
                        hold_claim(grasp, answer.then), turn_claim(grasp, answer.taken)};
  claim.options.angle_deg = answer.option.angle_deg;
  if (!answer.option.up.empty()) claim.options.up = answer.option.up;
  return claim;
}

TurnDocument<3> claims_of(const Grasp<3>& grasp, const TurnAnswer<3>& answer) {
  TurnDocument<3> claim{{},
                        hold_claim(grasp, answer.now),
                        hold_claim(grasp, answer.then),
                        turn_claim(grasp, answer.taken, answer.orientation)};
  const TurnSettings& settings = answer.settings;
  claim.options = {.force_cap = settings.force_cap,
                   .objective = settings.objective,
                   .gap = settings.gap,
                   .max_holds = settings.max_holds,
                   .tilt = settings.tilt,
                   .orientation = rotation_claim(answer.orientation),
                   .up = answer.option.up};
  return claim;
}

CurveDocument claims_of(const Grasp<2>& grasp, const CurveAnswer& answer) {
  CurveDocument claim{.options = options_claim(answer.settings),
                      .arcs = arc_claims(answer.curve),
                      .holdable_arcs_deg = answer.curve.holdable,
                      .load_curves = load_curve_claims(answer.curve)};
  for (const Minimum<2>& each : answer.optima) {
    claim.optima.push_back(minimum_claim(grasp, each));
    claim.optima.back().type = each.optimum.maximum ? Extremum::max : Extremum::min;
  }
  return claim;
}

template <int Dim>
CapacityDocument<Dim> claims_of(const Grasp<Dim>& grasp, const CapacityAnswer<Dim>& answer) {
  CapacityDocument<Dim> claim;
  claim.options = {.force_cap = answer.force_cap,
                   .safety = answer.safety,
                   .grip = answer.grip,
                   .angle_deg = answer.option.angle_deg};
  if (!answer.option.up.empty()) claim.options.up = answer.option.up;
  const Hand<Dim> safe(grasp.contacts(), grasp.center(), answer.safety, grasp.mechanism());
  for (const CapacityAt<Dim>& at : answer.capacities) {
    const Load<Dim>& load = grasp.loads()[at.load];
    CapacityClaim<Dim> capacity{.posture = at.posture, .up = at.up};
    if constexpr (Dim == 2) capacity.angle_deg = degrees(angle_of(at.up));
    if (grasp.loads().size() > 1) capacity.load = at.load;
    capacity.weight = weight_claim<Dim>(grasp, load, at.capacity.weights);
    capacity.friction = friction_claim<Dim>(grasp, load, at.capacity.friction);
    capacity.command = hold_claim<Dim>(safe, load.size(grasp.length()), at.capacity.safe);
    capacity.shake = shake_claim(at.shake);
    capacity.tilted = at.tilting.angle;
    capacity.tilt = tilt_claim(at.tilting);
    claim.capacities.push_back(std::move(capacity));
  }
  return claim;
}

template <int Dim>
SturdyDocument<Dim> claims_of(const Grasp<Dim>& grasp, const SturdyAnswer<Dim>& answer) {
  const Sturdiest<Dim>& found = answer.found;
  SturdyDocument<Dim> claim;
  claim.options = {.force_cap = answer.settings.force_cap,
                   .gap = answer.settings.gap,
                   .max_holds = answer.settings.max_holds,
                   .tilt = answer.tilt};
  if constexpr (Dim == 2) claim.options.domain = answer.domain;
  claim.status = found.status;
  claim.bound = finite(found.bound);
  if (!found.shakes.empty()) {
    claim.up = found.up;
    if constexpr (Dim == 2) claim.angle_deg = degrees(angle_of(found.up));
    claim.acceleration = finite(found.acceleration);
  }
  for (const Shake<Dim>& shake : found.shakes) claim.shakes.push_back(shake_claim(shake));
  for (const ShakeCut<Dim>& cut : found.cuts) {
    claim.cuts.push_back({.y = cut.y, .rates = some_above_zero(cut.rates)});
    if (grasp.loads().size() > 1) claim.cuts.back().load = cut.load;
  }
  claim.holds = found.holds;
  return claim;
}

template <int Dim>
std::string document(const FileOf<Dim>& file, const Grasp<Dim>& grasp,
                     const CheckAnswer<Dim>& answer) {
  Json result = head("check");
  result.update({{"options", Json::object()},
                 {"name", file.name},
                 {"dimension", Dim},
                 {"safety", file.safety}});
  add_posture(result, file);
  result["loads"] = Json::array();
  for (const Load<Dim>& load : grasp.loads()) result["loads"].push_back(load_value<Dim>(load));
  result["shape"] = file.shape ? shape_value(*file.shape) : Json();
  result["contacts"] = Json::array();
  for (const Contact<Dim>& contact : grasp.contacts())
    result["contacts"].push_back(contact_value(contact));
  result["force_closure"] = answer.force_closure;
  if constexpr (Dim == 2) {
    Interval fork = answer.fork;
    result["fork_deg"] = fork.from < fork.to ? json_of(fork) : Json();
  }
  result["warnings"] = file.warnings;
  return json_text(result);
}

template <class Claims>
std::string text_of(Claims claims) {
  Json result = head(Claims::command);
  result.update(json_of(claims));
  return json_text(result);
}

template <int Dim>
Json summary(const Grasp<Dim>& grasp, const Posture<Dim>& posture) {
  return brief(hold_claim(grasp, posture));
}

template <int Dim>
Json summary(const Grasp<Dim>& grasp, const Best<Dim>& best) {
  const bool bounded = Dim == 2 ? best.holdable() : best.status != Status::unholdable;
  const Minimum<Dim>* first = best.holdable() ? &best.best() : nullptr;
  return {{"status", to_string(best.status)},
          {"best", brief(minimum_claim(grasp, first))},
          {"best_pinched", brief(minimum_claim(grasp, best.best_pinched()))},
          {"lower_bound", bounded ? json_value(best.lower_bound) : Json()},
          {"relative_gap", first ? json_value(best.relative_gap) : Json()}};
}

template std::string text_of(CurveDocument);
template std::string text_of(TurnDocument<2>);
template std::string text_of(TurnDocument<3>);
#define POISE_DOCUMENTS(Dim)                                                                     \
  template HoldDocument<Dim> claims_of(const Grasp<Dim>&, const HoldAnswer<Dim>&);               \
  template BestDocument<Dim> claims_of(const Grasp<Dim>&, const BestAnswer<Dim>&);               \
  template CapacityDocument<Dim> claims_of(const Grasp<Dim>&, const CapacityAnswer<Dim>&);       \
  template SturdyDocument<Dim> claims_of(const Grasp<Dim>&, const SturdyAnswer<Dim>&);           \
  template std::string text_of(HoldDocument<Dim>);                                               \
  template std::string text_of(BestDocument<Dim>);                                               \
  template std::string text_of(CapacityDocument<Dim>);                                           \
  template std::string text_of(SturdyDocument<Dim>);                                             \
  template std::string document(const FileOf<Dim>&, const Grasp<Dim>&, const CheckAnswer<Dim>&); \
  template Json summary(const Grasp<Dim>&, const Posture<Dim>&);                                 \
  template Json summary(const Grasp<Dim>&, const Best<Dim>&);
POISE_DOCUMENTS(2)
POISE_DOCUMENTS(3)

}  // namespace poise
