// poise turn: what it takes to turn to another posture.
#include "answer.hpp"

namespace poise {
namespace {

/// An angle, or a direction.
void read_target(Question& question, const std::string& text) {
  if (text.find(',') == std::string::npos)
    question.angle_deg =
        read_number("--to", text, "an angle in degrees, or a direction X,Y[,Z] as 0,0,1");
  else
    question.up = read_direction("--to", text, 2, 3, "0.5,0.8 (in space 0.5,0,0.8)");
}

}  // namespace

const Subcommand turn_command{
    "turn", "What the fingers need on the way to another posture", [](Flags& flags) -> Run {
      const auto asked = declare_question(flags, Command::turn);
      flags
          .value("--to", "UP|DEG", "The posture to turn to: X,Y,Z, in the plane X,Y or an angle",
                 [asked](const auto& text) { read_target(asked->question, text); })
          .required();
      flags.search(asked->question);
      flags.turned(asked->question);
      return [asked] { return answer(*asked); };
    }};

}  // namespace poise
