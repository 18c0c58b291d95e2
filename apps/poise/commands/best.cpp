// poise best: the posture in which the fingers press least.
#include "answer.hpp"

namespace poise {

const Subcommand best_command{
    "best", "The posture in which the fingers press least", [](Flags& flags) -> Run {
      const auto asked = declare_question(flags, Command::best);
      flags.search(asked->question);
      flags.turned(asked->question);
      return [asked] { return answer(*asked); };
    }};

}  // namespace poise
