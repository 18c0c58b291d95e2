// poise best: the posture in which the fingers press least.
#include "answer.hpp"

namespace poise {

const Subcommand best_command{
    "best", "The posture in which the fingers press least", [](Flags& flags) -> Run {
      const auto asked = declare_question(flags, Command::best);
      Question& question = asked->question;
      flags.search(question);
      flags.value("--tilt-from", "X,Y,Z", "Space: choose from postures near this one",
                  [&](const auto& text) {
                    const auto v = read_direction("--tilt-from", text, 3, 3, "0,0,1");
                    question.tilt_from = Vector<3>(v.data()).stableNormalized();
                  });
      flags.value("--tilt-max", "DEG", "Space: at most so far from it, 0 to 90",
                  [&](const auto& text) {
                    question.tilt_max_deg =
                        read_number("--tilt-max", text, "an angle from 0 to 90 degrees",
                                    [](double angle) { return angle >= 0 && angle <= 90; });
                  });
      flags.value(
          "--orientation", "W,X,Y,Z", "Space: how the object is turned now, object to world, +z up",
          [&](const auto& text) { question.orientation = read_quaternion("--orientation", text); });
      return [asked] { return answer(*asked); };
    }};

}  // namespace poise
