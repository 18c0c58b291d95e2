// poise check: how a grasp file is understood.
#include "answer.hpp"

namespace poise {

const Subcommand check_command{"check", "Say how a grasp file is understood, with warnings",
                               [](Flags& flags) -> Run {
                                 const auto asked = declare_question(flags, Command::check);
                                 return [asked] { return answer(*asked); };
                               }};

}  // namespace poise
