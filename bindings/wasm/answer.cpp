#include "answer.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "files/field.hpp"
#include "files/grasp_document.hpp"
#include "files/json_text.hpp"
#include "files/result.hpp"

namespace poise {
namespace {

/// The value of a key that is there, as a document of its own: paths begin there, places stay those
/// of the text.
Document part(const Document& whole, const Mapping& mapping, std::string_view key) {
  for (const Member& member : mapping)
    if (member.key == key) return {std::string(key), whole.text, member.value};
  return {};
}

PlanarFile read_grasp(const Document& request, const Field& root) {
  const Field grasp = root.get("grasp", "a grasp file");
  const auto* mapping = std::get_if<Mapping>(&request.root.data);
  const GraspFile file = grasp_from(part(request, *mapping, "grasp"));
  if (const auto* planar = std::get_if<PlanarFile>(&file)) return *planar;
  grasp.get("dimension", "2").fail("is 3, must be 2: answers in space are not here yet");
}

std::string answer(const Document& request) {
  const Field root(request);
  root.mapping({"command", "grasp", "angle_deg", "domain", "force_cap"});
  const std::string& command =
      root.get("command", "check, hold, best or curve").word({"check", "hold", "best", "curve"});
  const PlanarFile file = read_grasp(request, root);
  const Grasp<2> grasp = file.grasp();

  CurveSettings settings{.domain = file.domain};
  if (const auto domain = root.find("domain"))
    settings.domain = domain->word({"all", "pinched"}) == "all" ? Domain::all : Domain::pinched;
  if (const auto cap = root.find("force_cap")) {
    settings.force_cap = cap->number();
    if (!(settings.force_cap > 0 && settings.force_cap <= 1e9))
      cap->fail("must be above 0 and at most 1e9");
  }

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
  return hold_document(grasp, theta, hold(grasp, up_at(theta), hold_settings), hold_settings,
                       option);
}

}  // namespace

std::string answer(const std::string& request) {
  nlohmann::ordered_json error;
  try {
    return answer(parse_json(request, "request"));
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
