// poise contacts: where a gripper touches.
#include "answer.hpp"
#include "commands/grasp_output.hpp"

namespace poise {

const Subcommand contacts_command{
    "contacts", "Where a gripper touches: the grasp file with contacts", [](Flags& flags) -> Run {
      const auto file = std::make_shared<std::string>(), out = std::make_shared<std::string>();
      flags.grasp_file(*file);
      flags.file("-o,--out", "FILE", "The grasp file to write, instead of printing it", *out);
      return [file, out] {
        return std::visit(
            [&](const auto& read) {
              warn(read.warnings);
              return printed_or_written(read, WriteAs::contacts, *out);
            },
            read_grasp_file(*file));
      };
    }};

}  // namespace poise
