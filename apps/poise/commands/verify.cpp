// poise verify: a result checked again.
#include "verify.hpp"

#include "answer.hpp"

namespace poise {

const Subcommand verify_command{
    "verify", "Check a result of these commands again, by other means", [](Flags& flags) -> Run {
      struct Checked {
        std::string file{}, result{};
        bool json{false};
      };
      const auto checked = std::make_shared<Checked>();
      flags.grasp_file(checked->file);
      flags.json(checked->json);
      flags.argument("RESULT", "What check, hold, best, curve or capacity printed by --json",
                     checked->result, "files yaml|yml|json");
      return [checked] {
        const GraspFile grasp = read_grasp_file(checked->file);
        const Verdict found = verdict(grasp, checked->result, checked->json, style_of_output());
        return Reply{found.text, found.confirmed && !found.open, !found.confirmed};
      };
    }};

}  // namespace poise
