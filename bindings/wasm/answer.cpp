#include "answer.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "ask/ask.hpp"
#include "ask/document.hpp"
#include "dual/exact.hpp"
#include "files/degrees.hpp"
#include "files/field.hpp"
#include "files/grasp_document.hpp"
#include "files/grasp_writer.hpp"
#include "files/json_text.hpp"
#include "poise/grip.hpp"
#include "poise/shake.hpp"

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

/// How far the posture that is asked for is from what it can no longer hold.
template <int Dim>
std::string margins(const FileOf<Dim>& file, const Grasp<Dim>& grasp, Question question) {
  question.command = Command::hold;
  const auto answer = std::get<HoldAnswer<Dim>>(ask(file, grasp, question).of);
  const Load<Dim>& load = grasp.loads()[answer.posture.decides];
  const Vector<Dim>& up = answer.posture.up;
  const WeightRange<Dim> weights = weight_range(grasp, load, up, answer.settings);
  const LeastFriction<Dim> friction = least_friction(grasp, load, up, answer.settings);
  const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
  return json_text({{"weight", load.weight},
                    {"holdable", weights.holdable},
                    {"greatest_weight", number(weights.greatest.weight)},
                    {"friction_factor", number(friction.factor)}});
}

/// What the posture withstands besides the loads: accelerations, and tilting.
template <int Dim>
std::string shaken(const FileOf<Dim>& file, const Grasp<Dim>& grasp, Question question) {
  question.command = Command::hold;
  const Vector<Dim> up = std::get<HoldAnswer<Dim>>(ask(file, grasp, question).of).posture.up;
  const ShakeSettings settings{.force_cap = question.force_cap};
  const Shake<Dim> found = shake(grasp, up, settings);
  const Tilting<Dim> tilted = tilting(grasp, up, settings);
  const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
  return json_text(
      {{"holdable", found.holdable},
       {"acceleration", number(found.acceleration)},
       {"bound", number(found.bound)},
       {"direction", std::vector<double>(found.direction.begin(), found.direction.end())},
       {"tilt_deg", degrees(tilted.angle)},
       {"tilt_bound_deg", degrees(tilted.bound)},
       {"proven", found.proven && tilted.proven}});
}

/// F or V at each of the postures `ups`, null where unholdable.
Json values(const Grasp<3>& grasp, const std::vector<Field>& ups, const HoldSettings& settings) {
  Json result = Json::array();
  std::vector<Hold<3>> holds(grasp.loads().size());  // in the posture before
  for (const Field& each : ups) {
    const Vector<3> up = each.vector<3>().stableNormalized();
    double most = 0;
    for (std::size_t k = 0; k < holds.size(); ++k) {
      const Load<3>& load = grasp.loads()[k];
      Hold<3> there;
      if (holds[k].holdable)
        there = hold<3>(grasp, load.at(up), load.weight, holds[k].dual, settings);
      if (!there.holdable) there = hold<3>(grasp, load, up, settings);
      most = std::max(most, there.holdable ? there.value() : INFINITY);
      holds[k] = std::move(there);
    }
    result.push_back(std::isfinite(most) ? Json(most) : Json());
  }
  return result;
}

/// What each cut says of any x in R^3, x = 1 being the weight: rate value >= a . x - b, with the
/// value F or V.
Json planes(const Grasp<3>& grasp, const std::vector<Field>& cuts, const HoldSettings& settings) {
  const bool is_grip = settings.objective == Objective::grip;
  const bool in_parts = is_grip && grip_unit(grasp) == GripUnit::part_of_max;
  double greatest = 0;
  for (const Load<3>& load : grasp.loads()) greatest = std::max(greatest, load.weight);
  Json result = Json::array();
  for (const Field& cut : cuts) {
    if (const auto n = cut.find("n")) {
      const Vector<3> a = n->vector<3>();
      result.push_back({{"a", {a.x(), a.y(), a.z()}}, {"b", 0}, {"rate", 0}});
      continue;
    }
    const auto index = static_cast<std::size_t>(cut.get("load", "an index").number());
    if (index >= grasp.loads().size()) cut.fail("is of a load that the grasp does not have");
    const Load<3>& load = grasp.loads()[index];
    const std::vector<Field> parts = cut.get("y", "six numbers").list();
    if (parts.size() != 6) cut.fail("must have a y of six numbers");
    Twist<3> y;
    for (Eigen::Index k = 0; k < 6; ++k) y[k] = parts[static_cast<std::size_t>(k)].number();
    const auto given = cut.find("rates");
    const std::vector<Field> list = given ? given->list() : std::vector<Field>{};
    dual::Rates rates(list.size());
    double sum = 0;
    for (std::size_t k = 0; k < list.size(); ++k) sum += rates[k] = list[k].number();
    if (!rates.empty() && rates.size() != grasp.drives().size())
      cut.fail("must have a rate for each drive");
    const auto proven =
        static_cast<double>(is_grip ? dual::grip_bound<3>(grasp, load.still(), y, rates, in_parts,
                                                          settings.force_cap * greatest)
                                    : dual::effort_bound<3>(grasp, load.still(), y, rates, 1));
    const double times = is_grip ? 1 : 2;
    Json a = Json::array();
    for (int k = 0; k < 3; ++k)
      a.push_back(times * y.dot(load.at(Vector<3>::Unit(k)) - load.still()));
    result.push_back({{"a", std::move(a)}, {"b", -proven}, {"rate", is_grip ? sum : 1}});
  }
  return result;
}

/// With the objective that is asked for, else that of the file; the effort where there is no grip.
template <int Dim>
Question question_of(const Field& root, const std::string& word, const FileOf<Dim>& file,
                     const Grasp<Dim>& grasp) {
  constexpr std::pair<const char*, Command> commands[] = {{"check", Command::check},
                                                          {"hold", Command::hold},
                                                          {"best", Command::best},
                                                          {"turn", Command::turn},
                                                          {"curve", Command::curve}};
  Question question{.objective = file.objective, .force_cap = read_cap(root)};
  if (const auto objective = root.find("objective"))
    question.objective =
        objective->word({"grip", "effort"}) == "grip" ? Objective::grip : Objective::effort;
  if (!has_grip(grasp)) question.objective = Objective::effort;
  for (const auto& [name, command] : commands)
    if (word == name) question.command = command;
  if (const auto with_turn = root.find("with_turn")) question.with_turn = with_turn->truth();
  return question;
}

/// In what the grip is told, and what is least if nothing is asked for.
template <int Dim>
std::string objectives(const FileOf<Dim>& file, const Grasp<Dim>& grasp) {
  return json_text({{"objective", to_string(file.objective)},
                    {"grip_unit", has_grip(grasp) ? Json(to_string(grip_unit(grasp))) : Json()}});
}

std::string answer(const std::string& command, const Field& root, const PlanarFile& file) {
  root.mapping({"command", "grasp", "angle_deg", "domain", "force_cap", "objective", "with_turn"},
               {"up", "ups", "cuts"}, "is for space, not for the plane");
  root.get("command", "")
      .word({"check", "hold", "best", "turn", "curve", "margins", "shake", "objectives"});
  const Grasp<2> grasp = file.grasp();
  Question question = question_of<2>(root, command, file, grasp);
  if (const auto domain = root.find("domain"))
    question.domain =
        domain->word({"all", "pinching-up"}) == "all" ? Domain::all : Domain::pinching_up;
  if (command == "turn") root.get("angle_deg", "a posture to turn to");
  if (const auto angle = root.find("angle_deg")) question.angle_deg = angle->number();
  if (command == "margins") return margins<2>(file, grasp, question);
  if (command == "shake") return shaken<2>(file, grasp, question);
  if (command == "objectives") return objectives<2>(file, grasp);
  return document(file, grasp, ask(file, grasp, question));
}

std::string answer(const std::string& command, const Field& root, const SpatialFile& file) {
  root.mapping({"command", "grasp", "up", "force_cap", "objective", "with_turn", "ups", "cuts"},
               {"angle_deg", "domain"}, "is for the plane, not for space");
  root.get("command", "")
      .word(
          {"check", "hold", "best", "turn", "margins", "shake", "objectives", "values", "planes"});
  const Grasp<3> grasp = file.grasp();
  Question question = question_of<3>(root, command, file, grasp);
  if (command == "turn") root.get("up", "a posture to turn to");
  if (const auto up = root.find("up")) {
    const Vector<3> given = up->vector<3>();
    if (!(given.stableNorm() > 0)) up->fail("has no length, must be a direction");
    question.up.assign(given.begin(), given.end());
  }
  if (command == "margins") return margins<3>(file, grasp, question);
  if (command == "shake") return shaken<3>(file, grasp, question);
  if (command == "objectives") return objectives<3>(file, grasp);
  const HoldSettings settings{.force_cap = question.force_cap, .objective = *question.objective};
  const std::string objective = to_string(settings.objective);
  if (command == "values")
    return json_text({{"objective", objective},
                      {"values", values(grasp, root.get("ups", "directions").list(), settings)}});
  if (command == "planes")
    return json_text(
        {{"objective", objective},
         {"planes", planes(grasp, root.get("cuts", "those of best").list(), settings)}});
  return document(file, grasp, ask(file, grasp, question));
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
