// The commands of the program. Each is a file of commands/, which says what it takes and does it.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "flags.hpp"

namespace poise {

/// What a command has to say.
struct Reply {
  std::string text;   ///< for standard output
  bool yes{true};     ///< it can be held (somewhere), or is confirmed
  bool proven{true};  ///< that it cannot, where it does not say yes
};
using Run = std::function<Reply()>;

struct Subcommand {
  const char* name;
  const char* help;
  /// Declares arguments and flags; what is returned may run once they are read.
  Run (*declare)(Flags& flags);
};

extern const Subcommand check_command, hold_command, best_command, turn_command, curve_command,
    capacity_command, motion_command, draw_command, verify_command, contacts_command, batch_command,
    view_command, import_command;

/// What a command line asks for, or a text instead (help, version, completion).
/// @throws UsageError
std::variant<Run, std::string> read_command_line(int argc, const char* const* argv);

}  // namespace poise
