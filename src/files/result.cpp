#include "files/result.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "files/json_text.hpp"

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

Json contacts(const Grasp<2>& grasp, const Hold<2>& hold) {
  Json result = Json::array();
  for (std::size_t i = 0; i < hold.forces.size(); ++i) {
    const Contact<2>& contact = grasp.contacts()[i];
    const ContactForce<2>& force = hold.forces[i];
    result.push_back({{"finger", contact.finger},
                      {"friction_used", number(force.friction_used)},
                      {"normal_force", number(force.normal)},
                      {"tangential_force", number(force.tangential)},
                      {"force", list(force_vector(contact, force))},
                      {"state", to_string(force.state)},
                      {"limit", to_string(force.limit)}});
  }
  return result;
}

void add_hold(Json& result, const Grasp<2>& grasp, double theta, const Hold<2>& hold) {
  const Vector<2> up = up_at(theta);
  result["holdable"] = hold.holdable;
  result["up"] = list(up);
  result["angle_deg"] = degrees(theta);
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

/// As it is written in a grasp file, in metres.
Json shape_value(const Shape& shape) {
  if (const auto* disk = std::get_if<Disk>(&shape)) return {{"disk", {{"radius", disk->radius}}}};
  if (const auto* ellipse = std::get_if<Ellipse>(&shape))
    return {{"ellipse", {{"radii", list(ellipse->radii)}}}};
  Json vertices = Json::array();
  for (const Vector<2>& vertex : std::get<Polygon>(shape).vertices)
    vertices.push_back(list(vertex));
  return {{"polygon", std::move(vertices)}};
}

}  // namespace

double degrees(double radians) { return number(radians / (pi / 180)); }

Vector<2> force_vector(const Contact<2>& contact, const ContactForce<2>& force) {
  const Vector<2>& n = contact.normal;
  return force.normal * n + force.tangential * Vector<2>(-n.y(), n.x());
}

std::string check_document(const GraspFile& file, const Grasp<2>& grasp) {
  Json result = document("check", Json::object());
  result["name"] = file.name;
  result["dimension"] = file.dimension;
  result["safety"] = file.safety;
  result["angle_deg"] = file.angle ? Json(degrees(*file.angle)) : Json();
  result["domain"] = word(file.domain);
  result["weight"] = grasp.object().weight;
  result["com"] = list(grasp.object().com);
  result["shape"] = file.shape ? shape_value(*file.shape) : Json();
  result["contacts"] = Json::array();
  for (const Contact<2>& contact : grasp.contacts()) {
    const bool capped = std::isfinite(contact.max_normal);
    result["contacts"].push_back({{"finger", contact.finger},
                                  {"position", list(contact.position)},
                                  {"normal", list(contact.normal)},
                                  {"friction", number(contact.friction)},
                                  {"min_normal", number(contact.min_normal)},
                                  {"max_normal", capped ? Json(contact.max_normal) : Json()},
                                  {"share", contact.share}});
  }
  result["force_closure"] = force_closure(grasp);
  const Interval cradled = cradled_wedge(grasp);
  result["cradled_deg"] = cradled.from < cradled.to ? list(cradled) : Json();
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
  result["status"] = !best.optimal() ? "gap" : holdable ? "optimal" : "unholdable";
  result["best"] = holdable ? optimum(grasp, best.best()) : Json();
  result["best_pinched"] = pinched ? optimum(grasp, *pinched) : Json();
  result["minima"] = Json::array();
  for (const PlanarPosture& minimum : best.minima)
    result["minima"].push_back(optimum(grasp, minimum));
  result["worst"] = best.worst ? optimum(grasp, *best.worst) : Json();
  result["lower_bound"] = holdable ? Json(number(best.lower_bound)) : Json();
  result["relative_gap"] = Json();
  if (holdable) {
    const double effort = best.best().hold.effort;
    result["relative_gap"] = number((effort - best.lower_bound) / effort);
  }
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

}  // namespace poise
