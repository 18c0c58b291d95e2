// poise best: the posture in which the fingers press least, or that withstands most.
#include <algorithm>

#include "answer.hpp"
#include "tables/candidates.hpp"

namespace poise {
namespace {

/// Ranks the candidates of a file.
Reply rank(const Asked& asked, const std::string& table) {
  if (asked.question.command == Command::sturdiest)
    throw UsageError("--objective: sturdy does not rank --candidates, ask for grip or effort");
  return with_grasp(asked.file, [&]<class File>(const File& file, const auto& grasp) -> Reply {
    constexpr int Dim = std::is_same_v<File, PlanarFile> ? 2 : 3;
    warn(file.warnings);
    const Candidates<Dim> candidates = read_candidates<Dim>(table);
    const auto list = ranked<Dim>(file, grasp, asked.question, candidates);
    return {asked.json
                ? lines_of<Dim>(candidates, list)
                : report<Dim>(file, grasp, asked.question, candidates, list, style_of_output()),
            std::any_of(list.begin(), list.end(), [](const auto& each) { return each.holdable; })};
  });
}

}  // namespace

const Subcommand best_command{
    "best", "The posture in which the fingers press least", [](Flags& flags) -> Run {
      const auto asked = declare_question(flags, Command::best);
      const auto candidates = std::make_shared<std::string>();
      flags.search(asked->question, true);
      flags.turned(asked->question);
      flags.file("--candidates", "CSV", "Rank these postures: quaternions or ups, with a header",
                 *candidates);
      return [asked, candidates] {
        return candidates->empty() ? answer(*asked) : rank(*asked, *candidates);
      };
    }};

}  // namespace poise
