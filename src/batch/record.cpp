#include "batch/record.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "files/result.hpp"
#include "files/spatial.hpp"

namespace poise {
namespace {

using Json = nlohmann::ordered_json;

constexpr double degree = 3.14159265358979323846 / 180;

Vector<2> up_of(const PlanarFile& file, const Question& question) {
  if (question.up.size() == 3)
    throw InvalidGrasp("up", "has 3 numbers, must have 2: the grasp is in the plane");
  if (!question.up.empty()) return {question.up[0], question.up[1]};
  return up_at(question.angle_deg ? *question.angle_deg * degree : file.angle.value_or(0));
}

Vector<3> up_of(const SpatialFile& file, const Question& question) {
  if (question.angle_deg)
    throw InvalidGrasp("angle", "is for the plane, the grasp is in space: give up");
  if (question.up.size() == 2)
    throw InvalidGrasp("up", "has 2 numbers, must have 3: the grasp is in space");
  if (!question.up.empty()) return Vector<3>(question.up.data()).stableNormalized();
  return file.up.value_or(Vector<3>(Vector<3>::UnitZ()));
}

Json answer(const PlanarFile& file, const Question& question) {
  const Grasp<2> grasp = file.grasp();
  if (question.hold) {
    const double theta = angle_of(up_of(file, question));
    return hold_summary(grasp, theta, hold(grasp, up_at(theta), {.force_cap = question.force_cap}));
  }
  return best_summary(grasp, best_posture(grasp, {.domain = question.domain.value_or(file.domain),
                                                  .force_cap = question.force_cap}));
}

Json answer(const SpatialFile& file, const Question& question) {
  const std::vector<Grasp<3>> grasps = file.grasps();
  if (question.hold)
    return hold_summary(grasps,
                        hold_all(grasps, up_of(file, question), {.force_cap = question.force_cap}));
  if (question.domain.value_or(Domain::all) != Domain::all)
    throw InvalidGrasp("domain", "pinched is for the plane, the grasp is in space");
  SpatialSettings settings;
  settings.force_cap = question.force_cap;
  settings.gap = question.gap.value_or(settings.gap);
  settings.max_holds = question.max_holds.value_or(settings.max_holds);
  settings.tilt = file.tilt;
  return best_summary(grasps, best_posture(grasps, settings));
}

Json problem(Place place, const std::string& path, const std::string& words) {
  Json result = Json::object();
  if (place.line > 0) result.update({{"line", place.line}, {"column", place.column}});
  if (!path.empty()) result["path"] = path;
  result["problem"] = words;
  return {{"error", std::move(result)}};
}

/// What comes after the key.
Json answer(const std::function<GraspFile()>& read, const Question& question) {
  try {
    return std::visit(
        [&](const auto& file) {
          Json result = Json::object();
          if (!file.name.empty()) result["name"] = file.name;
          result.update(answer(file, question));
          return result;
        },
        read());
  } catch (const FileError& error) {
    return problem({error.line(), error.column()}, error.path(), error.problem());
  } catch (const InvalidGrasp& error) {
    return problem({}, error.path(), error.problem());
  }
}

Outcome outcome(const Json& record) {
  if (record.contains("error")) return Outcome::bad;
  const bool none = record.contains("best") ? record["best"].is_null() : !record["holdable"];
  return none ? Outcome::unholdable : Outcome::answered;
}

}  // namespace

Record answer_record(const RecordKey& key, const std::function<GraspFile()>& read,
                     const Question& question) {
  Json record = {{"record", key.record}};
  if (!key.file.empty()) record["file"] = key.file;
  if (key.grasp) record["grasp"] = *key.grasp;
  record.update(answer(read, question));
  return {record.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n', outcome(record)};
}

GraspFile grasp_of_line(const std::string& line) {
  if (line.size() > longest_line) throw FileError("", {}, "", "is longer than 1 MiB");
  return grasp_from_json(line, "");
}

GraspFile grasp_of_acronym(const Acronym& data, std::size_t n) {
  try {
    return data.grasp(n);
  } catch (const MissedGrip& missed) {
    throw FileError("", {}, "gripper", missed.what());
  }
}

RecordKey key_of_acronym(const std::string& file, std::size_t n) {
  return {.file = std::filesystem::path(file).filename().string(), .grasp = n};
}

std::optional<Outcome> outcome_of(const std::string& line) {
  const Json record = Json::parse(line, nullptr, false);
  if (!record.is_object() || !record.contains("record")) return {};
  return outcome(record);
}

}  // namespace poise
