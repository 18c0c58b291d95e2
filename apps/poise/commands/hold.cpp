// poise hold: the least contact forces in one posture.
#include "answer.hpp"

namespace poise {

const Subcommand hold_command{"hold", "The least contact forces in one posture",
                              [](Flags& flags) -> Run {
                                const auto asked = declare_question(flags, Command::hold);
                                flags.posture(asked->question);
                                flags.objective(asked->question);
                                flags.force_cap(asked->question);
                                return [asked] { return answer(*asked); };
                              }};

}  // namespace poise
