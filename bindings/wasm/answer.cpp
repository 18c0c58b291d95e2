#include "answer.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "dual/dual.hpp"
#include "files/field.hpp"
#include "files/grasp_document.hpp"
#include "files/grasp_writer.hpp"
#include "files/json_text.hpp"
#include "files/result.hpp"
#include "files/spatial.hpp"
#include "poise/capacity.hpp"
#include "dual/twist.hpp"

namespace poise {
namespace {

using Json = nlohmann::ordered_json;

/// The value of a key that is there, as a document of its own: paths begin there, places stay those
/// of the text.
Document part(const Document& whole, const Mapping& mapping, std::string_view key) {
  for (const Member& member : mapping)
    if (member.key == key) return {std::string(key), whole.text, member.value};
  return {};
}

double read_cap(const Field& root) {
  const auto cap = root.find("force_cap");
  if (!cap) return HoldSettings{}.force_cap;
  if (!(cap->number() > 0 && cap->number() <= 1e9)) cap->fail("must be above 0 and at most 1e9");
  return cap->number();
}

/// How far a posture is from what it can no longer hold.
template <int Dim>
std::string margins(const Grasp<Dim>& grasp, const Vector<Dim>& up, const HoldSettings& settings) {
  const WeightRange<Dim> weights = weight_range(grasp, up, settings);
  const LeastFriction<Dim> friction = least_friction(grasp, up, settings);
  const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
  return json_text({{"weight", grasp.object().weight},
                    {"holdable", weights.holdable},
                    {"greatest_weight", number(weights.greatest.weight)},
                    {"friction_factor", number(friction.factor)}});
}

std::string answer(const std::string& command, const Field& root, const PlanarFile& file) {
  root.mapping({"command", "grasp", "angle_deg", "domain", "force_cap"}, {"up", "ups", "cuts"},
               "is for space, not for the plane");
  root.get("command", "").word({"check", "hold", "best", "curve", "margins"});
  const Grasp<2> grasp = file.grasp();
  CurveSettings settings{.domain = file.domain, .force_cap = read_cap(root)};
  if (const auto domain = root.find("domain"))
    settings.domain = domain->word({"all", "pinched"}) == "all" ? Domain::all : Domain::pinched;

  if (command == "check") return check_document(file, grasp);
  if (command == "best") return best_document(grasp, best_posture(grasp, settings), settings);
  if (command == "curve") return curve_document(grasp, posture_curve(grasp, settings), settings);
  PostureOption option;
  double theta = file.angle.value_or(0);
  if (const auto angle = root.find("angle_deg")) {
    const double degrees = std::remainder(angle->number(), 360.0);
    option.angle_deg = degrees <= -180 ? 180 : degrees;
    theta = *option.angle_deg * (3.14159265358979323846 / 180);
  }
  const HoldSettings hold_settings{.force_cap = settings.force_cap};
  if (command == "margins") return margins<2>(grasp, up_at(theta), hold_settings);
  return hold_document(grasp, theta, hold(grasp, up_at(theta), hold_settings), hold_settings,
                       option);
}

/// V at each of the postures `ups`, null where unholdable.
Json efforts(const std::vector<Grasp<3>>& grasps, const std::vector<Field>& ups,
             const HoldSettings& settings) {
  Json result = Json::array();
  std::vector<Twist<3>> from(grasps.size());
  std::vector<char> warm(grasps.size(), 0);
  for (const Field& each : ups) {
    const Vector<3> up = each.vector<3>().stableNormalized();
    double most = 0;
    for (std::size_t k = 0; k < grasps.size(); ++k) {
      Hold<3> there;
      if (warm[k]) there = hold<3>(grasps[k], grasps[k].load(up), from[k], settings);
      if (!there.holdable) there = hold<3>(grasps[k], up, settings);
      warm[k] = there.holdable;
      from[k] = there.dual;
      most = std::max(most, there.holdable ? there.effort : INFINITY);
    }
    result.push_back(std::isfinite(most) ? Json(most) : Json());
  }
  return result;
}

/// What each cut says of any x in R^3: V(x) >= a . x - b, x = 1 being the weight [N^2].
Json planes(const std::vector<Grasp<3>>& grasps, const std::vector<Field>& cuts) {
  Json result = Json::array();
  for (const Field& cut : cuts) {
    Vector<3> a;
    double b = 0;
    if (const auto n = cut.find("n")) {
      a = n->vector<3>();
    } else {
      const auto scenario = static_cast<std::size_t>(cut.get("scenario", "an index").number());
      if (scenario >= grasps.size()) cut.fail("is of a scenario that the grasp does not have");
      const Grasp<3>& grasp = grasps[scenario];
      Twist<3> y;
      const std::vector<Field> parts = cut.get("y", "six numbers").list();
      if (parts.size() != 6) cut.fail("must have a y of six numbers");
      for (std::size_t k = 0; k < 6; ++k) y[static_cast<Eigen::Index>(k)] = parts[k].number();
      y = about_com(grasp, y);
      dual::Point<3> point(grasp.scaled().size);
      dual::evaluate<3, double>(grasp.scaled(), Wrench<3>::Zero(), y, point);
      const double square = grasp.object().weight * grasp.object().weight;
      a = 2 * square * y.head<3>();
      b = -2 * square * point.value;
    }
    result.push_back({{"a", {a.x(), a.y(), a.z()}}, {"b", b}});
  }
  return result;
}

std::string answer(const std::string& command, const Field& root, const SpatialFile& file) {
  root.mapping({"command", "grasp", "up", "force_cap", "ups", "cuts"}, {"angle_deg", "domain"},
               "is for the plane, not for space");
  root.get("command", "").word({"check", "hold", "best", "margins", "efforts", "planes"});
  const std::vector<Grasp<3>> grasps = file.grasps();
  const HoldSettings settings{.force_cap = read_cap(root)};

  if (command == "check") return check_document(file, grasps);
  if (command == "efforts")
    return json_text(
        {{"efforts", efforts(grasps, root.get("ups", "directions").list(), settings)}});
  if (command == "planes")
    return json_text({{"planes", planes(grasps, root.get("cuts", "those of best").list())}});
  if (command == "best") {
    SpatialSettings wanted;
    wanted.force_cap = settings.force_cap;
    wanted.tilt = file.tilt;
    const Vector<3> up = file.up.value_or(Vector<3>(Vector<3>::UnitZ()));
    return best_document(grasps, best_posture(grasps, wanted), wanted, orientation_of(up));
  }
  std::optional<Vector<3>> option;
  if (const auto up = root.find("up")) {
    option = up->vector<3>();
    if (!(option->stableNorm() > 0)) up->fail("has no length, must be a direction");
  }
  const Vector<3> up =
      option ? option->stableNormalized() : file.up.value_or(Vector<3>(Vector<3>::UnitZ()));
  const SpatialPosture posture = hold_all(grasps, up, settings);
  if (command == "margins") return margins<3>(grasps[posture.scenario], up, settings);
  return hold_document(grasps, posture, settings, option);
}

/// The bytes that hexadecimal digits spell, two for each.
std::string bytes(const Field& field) {
  const std::string& digits = field.text();
  std::string result;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    result += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
  return result;
}

std::string answer(const Document& request) {
  const Field root(request);
  const std::string& command = root.get("command", "what to do").text();
  if (command == "read") {
    root.mapping({"command", "bytes", "file"});
    const auto text = root.find("bytes");
    return std::visit([](const auto& file) { return grasp_document(file); },
                      grasp_from_yaml(text ? bytes(*text) : "", root.get("file", "a name").text()));
  }
  root.get("grasp", "a grasp file");
  const auto* mapping = std::get_if<Mapping>(&request.root.data);
  return std::visit([&](const auto& file) { return answer(command, root, file); },
                    grasp_from(part(request, *mapping, "grasp")));
}

}  // namespace

std::string answer(const std::string& request) {
  Json error;
  try {
    return answer(parse_json(request, "request", max_result));
  } catch (const FileError& bad) {
    error = {{"path", bad.path()},
             {"line", bad.line()},
             {"column", bad.column()},
             {"problem", bad.problem()},
             {"message", bad.what()}};
  } catch (const std::exception& defect) {
    error = {{"problem", defect.what()}, {"message", defect.what()}};
  }
  return json_text({{"error", std::move(error)}});
}

}  // namespace poise
