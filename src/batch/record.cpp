#include "batch/record.hpp"

#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>

#include "ask/ask.hpp"
#include "ask/document.hpp"
#include "files/json_text.hpp"

namespace poise {
namespace {

using Json = nlohmann::ordered_json;

/// The answer in few words. Of a question about many grasps, those in the plane take what is for
/// them.
template <class File>
Json answer(const File& file, Question question) {
  question.with_turn = false;
  if constexpr (std::is_same_v<File, PlanarFile>) {
    question.gap.reset();
    question.max_holds.reset();
  }
  const auto grasp = file.grasp();
  return std::visit(
      [&](const auto& answer) -> Json {
        if constexpr (requires { answer.posture; })
          return summary(grasp, answer.posture);
        else if constexpr (requires { answer.best; })
          return summary(grasp, answer.best);
        else
          throw std::logic_error("records are of best and hold");
      },
      ask(file, grasp, question).of);
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
  } catch (const Misfit& misfit) {
    return problem({}, misfit.option(),
                   misfit.problem() + " the grasp is in " +
                       (misfit.dimension() == 2 ? "the plane" : "space") +
                       (misfit.option() == "angle" ? ": give up" : ""));
  } catch (const std::bad_alloc&) {
    return problem({}, "", "needs more memory than there is");
  } catch (const std::exception& error) {  // of the others nothing is known
    return problem({}, "", std::string("defect in poise, please report it: ") + error.what());
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
  return {with_escapes(record.dump(-1, ' ', false, Json::error_handler_t::replace)) + '\n',
          outcome(record)};
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
