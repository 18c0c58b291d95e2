#include "batch.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "batch/batch.hpp"
#include "batch/hdf5.hpp"

namespace poise {
namespace {

using Json = nlohmann::ordered_json;

/// What may not change between a part and its continuation.
std::string described(const Question& question, const Inputs& inputs) {
  Json result = {{"poise", POISE_VERSION}, {"what", question.hold ? "hold" : "best"}};
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

}  // namespace

Answer batch(const Arguments& arguments) {
  const Question question{.hold = arguments.batch.hold,
                          .angle_deg = arguments.angle_deg,
                          .up = arguments.up,
                          .domain = arguments.domain,
                          .force_cap = arguments.force_cap,
                          .gap = arguments.gap,
                          .max_holds = arguments.max_holds};
  const std::unique_ptr<Inputs> inputs = open_inputs(arguments.batch.inputs, arguments.mesh_root);
  const std::string& path = arguments.out;
  Counts counts;
  Output output(path, described(question, *inputs), arguments.batch.resume,
                [&](const std::string& line) {
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
    answer_all(*inputs, question, output, counts, arguments.batch.strict,
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
  if (!arguments.batch.hdf5.empty()) write_hdf5(path + ".part", arguments.batch.hdf5);
  output.finish();
  std::fputs(fmt::format("{} records: {} answered, {} unholdable, {} bad\n", counts.all(),
                         counts.answered, counts.unholdable, counts.bad)
                 .c_str(),
             stderr);
  return {"", counts.bad == 0};
}

}  // namespace poise
