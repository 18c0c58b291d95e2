#include "files/result.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "files/grasp_writer.hpp"
#include "files/json_text.hpp"
#include "files/spatial.hpp"

namespace poise {
namespace {

using Json = nlohmann::ordered_json;

constexpr double pi = 3.14159265358979323846;

/// A number without the sign of zero.
double number(double value) { return value == 0 ? 0 : value; }

template <class Numbers>
Json list(const Numbers& numbers) {
  Json result = Json::array();
  for (const double value : numbers) result.push_back(number(value));
  return result;
}

/// [from, to] in degrees.
Json list(const Interval& interval) {
  return list(std::initializer_list<double>{degrees(interval.from), degrees(interval.to)});
}

const char* word(Domain domain) { return domain == Domain::all ? "all" : "pinched"; }

Json options(const CurveSettings& settings) {
  return {{"domain", word(settings.domain)}, {"force_cap", settings.force_cap}};
}

Json document(const char* command, Json options) {
  return {{"poise_result", 1}, {"command", command}, {"options", std::move(options)}};
}

template <int Dim>
Json contacts(const Grasp<Dim>& grasp, const Hold<Dim>& hold) {
  Json result = Json::array();
  for (std::size_t i = 0; i < hold.forces.size(); ++i) {
    const Contact<Dim>& contact = grasp.contacts()[i];
    const ContactForce<Dim>& force = hold.forces[i];
    Json entry = {{"finger", contact.finger},
                  {"friction_used", number(force.friction_used)},
                  {"normal_force", number(force.normal)}};
    if constexpr (Dim == 2) {
      entry["tangential_force"] = number(force.tangential);
    } else {
      entry["tangential_force"] = force.tangential.norm();
      if (contact.torsion > 0) entry["torsion_moment"] = number(force.torsion_moment);
    }
    entry["force"] = list(force_vector(contact, force));
    entry["state"] = to_string(force.state);
    entry["limit"] = to_string(force.limit);
    result.push_back(std::move(entry));
  }
  return result;
}

/// A hold in a posture, whose own keys are given.
template <int Dim>
void add_hold(Json& result, const Grasp<Dim>& grasp, const Vector<Dim>& up, const Json& posture,
              const Hold<Dim>& hold) {
  result["holdable"] = hold.holdable;
  result["up"] = list(up);
  result.update(posture);
  result["dual"] = list(hold.dual);
  result["lower_bound"] = number(hold.lower_bound);
  if (!hold.holdable) {
    result["reason"] = reason(grasp, hold);
    return;
  }
  result["effort"] = number(hold.effort);
  result["force_norm"] = std::sqrt(hold.effort);
  result["residual"] = hold.residual;
  result["manner"] = to_string(manner(grasp, up, hold));
  result["all_loaded"] = all_loaded(grasp, hold);
  result["grip_force"] = number(grip_force(grasp, hold));
  result["fingers"] = Json::array();
  const auto fingers = finger_forces(grasp, hold);
  for (std::size_t k = 0; k < fingers.size(); ++k)
    result["fingers"].push_back({{"finger", grasp.fingers()[k]},
                                 {"normal_force", number(fingers[k].normal)},
                                 {"force", list(fingers[k].force)}});
  result["contacts"] = contacts(grasp, hold);
}

void add_hold(Json& result, const Grasp<2>& grasp, double theta, const Hold<2>& hold) {
  add_hold<2>(result, grasp, up_at(theta), {{"angle_deg", degrees(theta)}}, hold);
}

/// The hold of the scenario that decides, and those of the others; null where one cannot be held.
void add_hold(Json& result, const std::vector<Grasp<3>>& grasps, const SpatialPosture& posture) {
  Json scenario = Json::object();
  if (grasps.size() > 1) {
    scenario["scenario"] = posture.scenario;
    Json efforts = Json::array(), holds = Json::array();
    for (std::size_t k = 0; k < grasps.size(); ++k) {
      const double effort = posture.scenario_efforts[k];
      efforts.push_back(std::isfinite(effort) ? Json(number(effort)) : Json());
      holds.push_back(Json());
      if (k == posture.scenario || !std::isfinite(effort)) continue;
      // That it is within the force cap is known.
      const HoldSettings settings{1.001 * std::sqrt(effort) / grasps[k].object().weight};
      add_hold<3>(holds.back(), grasps[k], posture.up, Json::object(),
                  hold<3>(grasps[k], posture.up, settings));
    }
    scenario["scenario_efforts"] = std::move(efforts);
    scenario["scenario_holds"] = std::move(holds);
  }
  add_hold<3>(result, grasps[posture.scenario], posture.up, scenario, posture.hold);
}

/// An optimum; in `curve`, where there are minima and maxima, with its type.
Json optimum(const Grasp<2>& grasp, const PlanarPosture& posture, bool with_type = false) {
  const Optimum& optimum = posture.optimum;
  Json result = {{"kind", to_string(optimum.kind)}};
  if (with_type) result["type"] = optimum.maximum ? "max" : "min";
  if (optimum.from != optimum.to) {
    result["from_deg"] = degrees(optimum.from);
    result["to_deg"] = degrees(optimum.to);
  }
  add_hold(result, grasp, optimum.angle, posture.hold);
  if (posture.two_slipping)
    result["edges_meet"] = posture.edges_meet ? list(*posture.edges_meet) : Json();
  return result;
}

Json optimum(const std::vector<Grasp<3>>& grasps, const SpatialPosture& posture) {
  Json hold = Json::object();
  add_hold(hold, grasps, posture);
  return hold;
}

/// A hold without its proof and its contacts; null stays null.
Json brief(Json hold) {
  if (hold.is_null()) return hold;
  for (const char* const key : {"dual", "residual", "contacts"}) hold.erase(key);
  return hold;
}

const char* status(const BestPosture& best) {
  return !best.optimal() ? "gap" : best.holdable() ? "optimal" : "unholdable";
}

/// Null where nothing holds.
Json relative_gap(const BestPosture& best) {
  if (!best.holdable()) return {};
  const double effort = best.best().hold.effort;
  return number((effort - best.lower_bound) / effort);
}

Json arcs(const Grasp<2>& grasp, const PostureCurve& curve) {
  Json result = Json::array();
  for (const Arc& arc : curve.arcs) {
    Json y = {{"c0", Json::array()}, {"cos1", Json::array()}, {"sin1", Json::array()}};
    for (const Harmonic1& part : arc.y) {
      y["c0"].push_back(number(part.c0));
      y["cos1"].push_back(number(part.cos1));
      y["sin1"].push_back(number(part.sin1));
    }
    Json states = Json::array();
    for (std::size_t i = 0; i < grasp.contacts().size(); ++i) {
      const ArcState& state = curve.states[arc.first_state + i];
      states.push_back({{"state", to_string(state.state)}, {"limit", to_string(state.limit)}});
    }
    result.push_back({{"from_deg", degrees(arc.from)},
                      {"to_deg", degrees(arc.to)},
                      {"V",
                       {{"c0", number(arc.V.c0)},
                        {"cos1", number(arc.V.cos1)},
                        {"sin1", number(arc.V.sin1)},
                        {"cos2", number(arc.V.cos2)},
                        {"sin2", number(arc.V.sin2)}}},
                      {"y", std::move(y)},
                      {"states", std::move(states)}});
  }
  return result;
}

Json unholdable_arcs(const PostureCurve& curve) {
  Json result = Json::array();
  for (const UnholdableArc& arc : curve.unholdable_arcs)
    result.push_back(
        {{"from_deg", degrees(arc.from)}, {"to_deg", degrees(arc.to)}, {"y", list(arc.y)}});
  return result;
}

Json holdable_arcs(const PostureCurve& curve) {
  Json result = Json::array();
  for (const Interval& interval : curve.holdable) result.push_back(list(interval));
  return result;
}

Json quaternion(const Eigen::Quaterniond& q) {
  return {{"w", number(q.w())}, {"x", number(q.x())}, {"y", number(q.y())}, {"z", number(q.z())}};
}

template <int Dim>
Json contact_values(const Grasp<Dim>& grasp) {
  Json result = Json::array();
  for (const Contact<Dim>& contact : grasp.contacts()) {
    const bool capped = std::isfinite(contact.max_normal);
    Json entry = {{"finger", contact.finger},
                  {"position", list(contact.position)},
                  {"normal", list(contact.normal)},
                  {"friction", number(contact.friction)}};
    if constexpr (Dim == 3) entry["torsion"] = number(contact.torsion);
    entry["min_normal"] = number(contact.min_normal);
    entry["max_normal"] = capped ? Json(contact.max_normal) : Json();
    entry["share"] = contact.share;
    result.push_back(std::move(entry));
  }
  return result;
}

template <int Dim>
Json check_head(const CommonFile<Dim>& file) {
  Json result = document("check", Json::object());
  result["name"] = file.name;
  result["dimension"] = Dim;
  result["safety"] = file.safety;
  return result;
}

template <int Dim>
void add_check(Json& result, const CommonFile<Dim>& file, const Grasp<Dim>& grasp) {
  result["shape"] = file.shape ? shape_value(*file.shape) : Json();
  result["contacts"] = contact_values(grasp);
  result["force_closure"] = force_closure(grasp);
}

}  // namespace

double degrees(double radians) { return number(radians / (pi / 180)); }

Vector<2> force_vector(const Contact<2>& contact, const ContactForce<2>& force) {
  const Vector<2>& n = contact.normal;
  return force.normal * n + force.tangential * Vector<2>(-n.y(), n.x());
}

Vector<3> force_vector(const Contact<3>& contact, const ContactForce<3>& force) {
  return force.normal * contact.normal + force.tangential;
}

std::string check_document(const PlanarFile& file, const Grasp<2>& grasp) {
  Json result = check_head(file);
  result["angle_deg"] = file.angle ? Json(degrees(*file.angle)) : Json();
  result["domain"] = word(file.domain);
  result["weight"] = grasp.object().weight;
  result["com"] = list(grasp.object().com);
  add_check(result, file, grasp);
  const Interval cradled = cradled_wedge(grasp);
  result["cradled_deg"] = cradled.from < cradled.to ? list(cradled) : Json();
  result["warnings"] = file.warnings;
  return json_text(result);
}

std::string check_document(const SpatialFile& file, const std::vector<Grasp<3>>& grasps) {
  Json result = check_head(file);
  result["up"] = file.up ? list(*file.up) : Json();
  result["tilt"] = file.tilt ? tilt_value(*file.tilt) : Json();
  result["scenarios"] = Json::array();
  for (const Grasp<3>& grasp : grasps)
    result["scenarios"].push_back(
        {{"weight", grasp.object().weight}, {"com", list(grasp.object().com)}});
  add_check(result, file, grasps.front());
  result["warnings"] = file.warnings;
  return json_text(result);
}

std::string hold_document(const Grasp<2>& grasp, double theta, const Hold<2>& hold,
                          const HoldSettings& settings, const PostureOption& option) {
  Json options = {{"force_cap", settings.force_cap}};
  if (option.angle_deg) options["angle_deg"] = number(*option.angle_deg);
  if (option.up) options["up"] = list(*option.up);
  Json result = document("hold", std::move(options));
  add_hold(result, grasp, theta, hold);
  if (option.angle_deg) result["angle_deg"] = number(*option.angle_deg);  // to the last digit
  return json_text(result);
}

std::string best_document(const Grasp<2>& grasp, const BestPosture& best,
                          const CurveSettings& settings) {
  Json result = document("best", options(settings));
  const bool holdable = best.holdable();
  const PlanarPosture* pinched = best.best_pinched();
  result["status"] = status(best);
  result["best"] = holdable ? optimum(grasp, best.best()) : Json();
  result["best_pinched"] = pinched ? optimum(grasp, *pinched) : Json();
  result["minima"] = Json::array();
  for (const PlanarPosture& minimum : best.minima)
    result["minima"].push_back(optimum(grasp, minimum));
  result["worst"] = best.worst ? optimum(grasp, *best.worst) : Json();
  result["lower_bound"] = holdable ? Json(number(best.lower_bound)) : Json();
  result["relative_gap"] = relative_gap(best);
  result["arcs"] = arcs(grasp, best.curve);
  result["unholdable_arcs"] = unholdable_arcs(best.curve);
  result["holdable_arcs_deg"] = holdable_arcs(best.curve);
  return json_text(result);
}

std::string curve_document(const Grasp<2>& grasp, const PostureCurve& curve,
                           const CurveSettings& settings) {
  Json result = document("curve", options(settings));
  result["optima"] = Json::array();
  for (const Optimum& each : curve.optima)
    result["optima"].push_back(optimum(grasp, posture_at(grasp, each, settings), true));
  result["arcs"] = arcs(grasp, curve);
  result["holdable_arcs_deg"] = holdable_arcs(curve);
  return json_text(result);
}

std::string hold_document(const std::vector<Grasp<3>>& grasps, const SpatialPosture& posture,
                          const HoldSettings& settings, const std::optional<Vector<3>>& up) {
  Json options = {{"force_cap", settings.force_cap}};
  if (up) options["up"] = list(*up);
  Json result = document("hold", std::move(options));
  add_hold(result, grasps, posture);
  return json_text(result);
}

std::string best_document(const std::vector<Grasp<3>>& grasps, const BestSpatialPosture& best,
                          const SpatialSettings& settings, const Eigen::Quaterniond& orientation) {
  Json options = {{"domain", word(Domain::all)},
                  {"force_cap", settings.force_cap},
                  {"gap", settings.gap},
                  {"max_holds", settings.max_holds}};
  if (settings.tilt) options["tilt"] = tilt_value(*settings.tilt);
  options["orientation"] = quaternion(orientation);
  Json result = document("best", std::move(options));
  const SpatialPosture* pinched = best.best_pinched();
  result["status"] = to_string(best.status);
  result["best"] = best.best ? optimum(grasps, *best.best) : Json();
  result["best_pinched"] = pinched ? optimum(grasps, *pinched) : Json();
  result["minima"] = Json::array();
  for (const SpatialPosture& minimum : best.minima)
    result["minima"].push_back(optimum(grasps, minimum));
  result["minima_complete"] = false;  // by descent from many starts
  result["lower_bound"] =
      best.status == Status::unholdable ? Json() : Json(number(best.lower_bound));
  result["relative_gap"] = best.best ? Json(number(best.relative_gap)) : Json();
  result["holds"] = best.holds;
  result["rotation"] = result["orientation"] = Json();
  if (best.best) {
    const Turn turn = turn_to(orientation, best.best->up);
    result["rotation"] = quaternion(turn.rotation);
    result["rotation"]["angle_deg"] = degrees(turn.angle);
    result["orientation"] = quaternion(turn.orientation);
  }
  result["cuts"] = Json::array();
  for (const Cut& cut : best.cuts)
    result["cuts"].push_back(cut.n ? Json{{"n", list(*cut.n)}}
                                   : Json{{"y", list(cut.y)}, {"scenario", cut.scenario}});
  return json_text(result);
}

namespace {

template <int Dim>
Json hold_at(const Grasp<Dim>& grasp, const Vector<Dim>& up, const Hold<Dim>& hold) {
  Json posture = Json::object(), result = Json::object();
  if constexpr (Dim == 2) posture["angle_deg"] = degrees(angle_of(up));
  add_hold<Dim>(result, grasp, up, posture, hold);
  return result;
}

/// A number that may be infinite: then null.
Json finite(double value) { return std::isfinite(value) ? Json(number(value)) : Json(); }

template <int Dim>
Json weights(const Grasp<Dim>& grasp, const Vector<Dim>& up, const WeightRange<Dim>& range,
             const HoldSettings& settings) {
  const WeightEnd<Dim>&least = range.least, &greatest = range.greatest;
  const bool any = std::isinf(greatest.weight);
  Json result = {{"given", grasp.object().weight},
                 {"holdable", range.holdable},
                 {"any", range.holdable && any},
                 {"greatest", range.holdable ? finite(greatest.weight) : Json()},
                 {"greatest_bound", finite(greatest.bound)},
                 {"greatest_dual", list(greatest.dual)},
                 {"least", range.holdable ? Json(least.weight) : Json()},
                 {"least_bound", least.bound},
                 {"least_dual", list(least.dual)}};
  if (!range.holdable) return result;
  result["greatest_hold"] =
      hold_at(any ? without_limits(grasp) : with_weight(grasp, greatest.weight), up, greatest.hold);
  if (least.weight > 0)
    result["least_hold"] = hold_at(with_weight(grasp, least.weight), up, least.hold);
  result["contacts"] = Json::array();
  if (any) return result;
  const std::vector<Deciding> decide = deciding(grasp, up, greatest.dual, settings);
  for (std::size_t i = 0; i < decide.size(); ++i)
    result["contacts"].push_back({{"finger", grasp.contacts()[i].finger},
                                  {"per_newton", decide[i].per_newton},
                                  {"slipping", decide[i].slipping}});
  return result;
}

template <int Dim>
Json friction(const Grasp<Dim>& grasp, const Vector<Dim>& up, const LeastFriction<Dim>& least) {
  Json result = {{"factor", finite(least.factor)},
                 {"bound", least.bound},
                 {"dual", list(least.dual)},
                 {"hold", Json()}};
  if (std::isfinite(least.factor))
    result["hold"] = hold_at(with_friction(grasp, least.factor), up, least.hold);
  return result;
}

}  // namespace

template <int Dim>
std::string capacity_document(const std::vector<Grasp<Dim>>& grasps,
                              const std::vector<CapacityAt<Dim>>& answers,
                              const CapacityOptions& options) {
  Json asked = {{"force_cap", options.force_cap}, {"safety", options.safety}};
  if (options.angle_deg) asked["angle_deg"] = number(*options.angle_deg);
  if (!options.up.empty()) asked["up"] = list(options.up);
  Json result = document("capacity", std::move(asked));
  result["capacities"] = Json::array();
  for (const CapacityAt<Dim>& answer : answers) {
    const Grasp<Dim>& grasp = grasps[answer.scenario];
    Json entry = {{"posture", answer.posture}, {"up", list(answer.up)}};
    if constexpr (Dim == 2) entry["angle_deg"] = degrees(angle_of(answer.up));
    if (grasps.size() > 1) entry["scenario"] = answer.scenario;
    entry["weight"] =
        weights(grasp, answer.up, answer.capacity.weights, {.force_cap = options.force_cap});
    entry["friction"] = friction(grasp, answer.up, answer.capacity.friction);
    entry["command"] =
        hold_at(with_friction(grasp, 1 / options.safety), answer.up, answer.capacity.safe);
    result["capacities"].push_back(std::move(entry));
  }
  return json_text(result);
}

template std::string capacity_document<2>(const std::vector<Grasp<2>>&,
                                          const std::vector<CapacityAt<2>>&,
                                          const CapacityOptions&);
template std::string capacity_document<3>(const std::vector<Grasp<3>>&,
                                          const std::vector<CapacityAt<3>>&,
                                          const CapacityOptions&);

Json hold_summary(const Grasp<2>& grasp, double theta, const Hold<2>& hold) {
  Json result = Json::object();
  add_hold(result, grasp, theta, hold);
  return brief(std::move(result));
}

Json hold_summary(const std::vector<Grasp<3>>& grasps, const SpatialPosture& posture) {
  return brief(optimum(grasps, posture));
}

Json best_summary(const Grasp<2>& grasp, const BestPosture& best) {
  const PlanarPosture* pinched = best.best_pinched();
  return {{"status", status(best)},
          {"best", best.holdable() ? brief(optimum(grasp, best.best())) : Json()},
          {"best_pinched", pinched ? brief(optimum(grasp, *pinched)) : Json()},
          {"lower_bound", best.holdable() ? Json(number(best.lower_bound)) : Json()},
          {"relative_gap", relative_gap(best)}};
}

Json best_summary(const std::vector<Grasp<3>>& grasps, const BestSpatialPosture& best) {
  const SpatialPosture* pinched = best.best_pinched();
  const bool unholdable = best.status == Status::unholdable;
  return {{"status", to_string(best.status)},
          {"best", best.best ? brief(optimum(grasps, *best.best)) : Json()},
          {"best_pinched", pinched ? brief(optimum(grasps, *pinched)) : Json()},
          {"lower_bound", unholdable ? Json() : Json(number(best.lower_bound))},
          {"relative_gap", best.best ? Json(number(best.relative_gap)) : Json()}};
}

}  // namespace poise
