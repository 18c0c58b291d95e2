// poise batch: many grasps, a line for each.
#include "batch/batch.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "batch/hdf5.hpp"
#include "commands.hpp"
#include "files/output.hpp"
#include "files/text.hpp"
#include "readers/input.hpp"

namespace poise {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct ManyAsked {
  std::vector<std::string> inputs{};
  std::string out{}, mesh_root{}, hdf5{}, what{"best"};
  bool resume{false}, strict{false};
  Question question{};
};

/// @throws UsageError for flags that do not go together
void check(const ManyAsked& asked) {
  const Question& question = asked.question;
  if (asked.what != "best" && asked.what != "hold")
    throw UsageError("--what: " + in_quotes(asked.what) + " must be best or hold");
  for (const auto& [given, flag, what] :
       {std::tuple(question.angle_deg.has_value(), "--angle", "hold"),
        {!question.up.empty(), "--up", "hold"},
        {question.domain.has_value(), "--domain", "best"},
        {question.gap.has_value(), "--gap", "best"},
        {question.max_holds.has_value(), "--max-holds", "best"}})
    if (given && asked.what != what)
      throw UsageError(std::string(flag) + ": is for --what " + what);
  for (const std::string& input : asked.inputs) {
    const bool acronym = has_ending(input, ".h5");
    if (acronym && asked.mesh_root.empty())
      throw UsageError(shown(input) + ": needs --mesh-root, the folder with its meshes/");
    if (!asked.hdf5.empty() && !acronym)
      throw UsageError("--hdf5: is for the ACRONYM data set, " + shown(input) +
                       " is not a file of it (.h5)");
  }
  if (asked.out.empty() && !asked.hdf5.empty()) throw UsageError("--hdf5: needs --out");
  std::set<std::string> groups;
  for (const std::string& input : asked.inputs)
    if (const std::string group = fs::path(input).stem().string();
        !asked.hdf5.empty() && !groups.insert(group).second)
      throw UsageError("--hdf5: two inputs would make the group " + shown(group));
  if (asked.out.empty() && asked.resume) throw UsageError("--resume: needs --out");
}

/// Before any work is done. @throws UsageError, FileError for arrays that cannot be written
void check_arrays(const std::string& arrays, const std::string& out) {
  if (target_of(arrays).is_stream || target_of(out).is_stream)
    throw UsageError("--hdf5: " + shown(arrays) + " and " + shown(out) + " must be files");
  for (const char* own : {"", ".part", ".run"})
    if (fs::weakly_canonical(fs::absolute(arrays)) ==
        fs::weakly_canonical(fs::absolute(target_of(out).path + own)))
      throw UsageError("--hdf5: must be another file than that of --out");
}

/// What may not change between a part and its continuation.
std::string described(const Question& question, const Inputs& inputs) {
  Json result = {{"poise", POISE_VERSION},
                 {"what", question.command == Command::hold ? "hold" : "best"}};
  if (question.angle_deg) result["angle_deg"] = *question.angle_deg;
  if (!question.up.empty()) result["up"] = question.up;
  if (question.domain) result["domain"] = *question.domain == Domain::all ? "all" : "pinched";
  result["force_cap"] = question.force_cap;
  if (question.gap) result["gap"] = *question.gap;
  if (question.max_holds) result["max_holds"] = *question.max_holds;
  result["inputs"] = inputs.identity();
  return result.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string duration(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

/// How far it is, on standard error: a bar on a terminal, elsewhere a line now and then.
class Progress {
 public:
  explicit Progress(const Inputs& inputs) : inputs_(inputs) {}

  void start(const Counts& counts) {
    first_ = counts.all();
    begin_ = shown_ = Clock::now();
    part_ = std::max(inputs_.part(), 0.);
  }
  void show(const Counts& counts) {
    const Clock::time_point now = Clock::now();
    if (now - shown_ < (terminal_ ? std::chrono::milliseconds(100) : std::chrono::seconds(10)))
      return;
    shown_ = now;
    const double seconds = std::chrono::duration<double>(now - begin_).count();
    const double part = inputs_.part();
    const double rate = static_cast<double>(counts.all() - first_) / seconds;
    std::string line = fmt::format("{} records, {:.{}f}/s", counts.all(), rate, rate < 100 ? 1 : 0);
    if (part > part_)
      line += fmt::format(", {:.0f} %, {} left", std::floor(100 * part),
                          duration(seconds * (1 - part) / (part - part_)));
    if (!terminal_) return say(line + "\n");
    constexpr int width = 30;
    if (part >= 0) {
      const int full = static_cast<int>(part * width);
      line = fmt::format("[{:=<{}}{: <{}}] ", "", full, "", width - full) + line;
    }
    say("\r" + line + "\033[K");
  }
  /// Takes the bar away.
  void end() const {
    if (terminal_) say("\r\033[K");
  }

 private:
  using Clock = std::chrono::steady_clock;
  static void say(const std::string& text) { std::fputs(text.c_str(), stderr); }

  const Inputs& inputs_;
  const bool terminal_ = isatty(STDERR_FILENO) == 1;
  Clock::time_point begin_, shown_;
  std::size_t first_{0};
  double part_{0};
};

/// Writes the records; tells on standard error how far it is, and at the end how many there are.
Reply batch(const ManyAsked& asked) {
  check(asked);
  Question question = asked.question;
  question.command = asked.what == "hold" ? Command::hold : Command::best;
  const std::unique_ptr<Inputs> inputs = open_inputs(asked.inputs, asked.mesh_root);
  const std::string& path = asked.out;
  if (!asked.hdf5.empty()) check_arrays(asked.hdf5, path);
  Counts counts;
  Output output(path, described(question, *inputs), asked.resume, [&](const std::string& line) {
    const std::optional<Outcome> outcome = outcome_of(line);
    if (!outcome)
      throw FileError(path + ".part", {static_cast<int>(counts.all()) + 1, 1}, "",
                      "is not a record: remove the file to start anew");
    counts.add(*outcome);
  });
  if (output.finished()) {
    std::fputs(("poise: " + path + " is finished\n").c_str(), stderr);
    return {};
  }
  Progress progress(*inputs);
  progress.start(counts);
  try {
    answer_all(*inputs, question, output, counts, asked.strict,
               [&](const Counts& now) { progress.show(now); });
  } catch (const BadRecord& bad) {
    progress.end();
    output.discard();
    throw FileError(
        path.empty() ? "standard output" : path, {}, "",
        "is not written on, as --strict is given and a record is bad: " + std::string(bad.what()));
  } catch (...) {
    progress.end();
    throw;
  }
  progress.end();
  if (!asked.hdf5.empty()) write_hdf5(output.part(), asked.hdf5);
  output.finish();
  std::fputs(fmt::format("{} records: {} answered, {} unholdable, {} bad\n", counts.all(),
                         counts.answered, counts.unholdable, counts.bad)
                 .c_str(),
             stderr);
  return {"", counts.bad == 0};
}

}  // namespace

const Subcommand batch_command{
    "batch", "Many grasps, a line of JSON for each", [](Flags& flags) -> Run {
      const auto asked = std::make_shared<ManyAsked>();
      flags.arguments("INPUT",
                      "JSON Lines, a grasp in each (- for standard input); a folder of grasp "
                      "files; or a file of the ACRONYM data set (.h5)",
                      asked->inputs, "files jsonl|h5");
      flags.file("-o,--out", "JSONL", "The file to write (standard output)", asked->out);
      flags.folder("--mesh-root", "ACRONYM: the folder with its meshes/", asked->mesh_root);
      flags.file("--hdf5", "H5", "ACRONYM: also write arrays that go with /grasps/transforms",
                 asked->hdf5);
      flags.value("--what", "best|hold", "The best posture (best), or the forces in one",
                  [asked](const std::string& text) { asked->what = text; });
      flags.posture(asked->question, "Posture of hold");
      flags.flag("--resume", "Go on where a run was ended", asked->resume);
      flags.flag("--strict", "Stop at a bad grasp", asked->strict);
      flags.search(asked->question);
      return [asked] { return batch(*asked); };
    }};

}  // namespace poise
