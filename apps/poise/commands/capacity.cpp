// poise capacity: what a gripper can hold in one posture.
#include "answer.hpp"

namespace poise {

const Subcommand capacity_command{
    "capacity", "The greatest weight, the least friction, the grip to command",
    [](Flags& flags) -> Run {
      const auto asked = declare_question(flags, Command::capacity);
      Question& question = asked->question;
      flags.posture(question);
      flags.force_cap(question);
      flags.value("--safety", "S",
                  "Divide the friction by this, on top of the file's safety, to find the force to "
                  "command (1.5)",
                  [&](const auto& text) {
                    question.safety = read_number(
                        "--safety", text, "a factor, must be at least 1 and at most 1e6",
                        [](double safety) { return safety >= 1 && safety <= 1e6; });
                  });
      flags.value("--grip", "F",
                  "Shake and tilt with at most this grip: newtons, newton metres, or a part of max",
                  [&](const auto& text) {
                    question.grip = read_number("--grip", text, "a grip, must be above 0",
                                                [](double grip) { return grip > 0; });
                  });
      return [asked] { return answer(*asked); };
    }};

}  // namespace poise
