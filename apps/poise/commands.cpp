#include "commands.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <deque>
#include <sstream>

#include "completion.hpp"
#include "files/text.hpp"

namespace poise {
namespace {

const Subcommand* const all_commands[] = {
    &check_command,    &hold_command,   &best_command,  &turn_command,   &curve_command,
    &capacity_command, &motion_command, &draw_command,  &verify_command, &contacts_command,
    &batch_command,    &view_command,   &import_command};

/// The command line as CLI11 sees it.
struct Parser {
  CLI::App app{
      "How to turn a held object so that its fingers press least, and how hard they press."};
  std::deque<Flags> flags{};
  std::vector<Run> runs{};

  Parser() {
    app.name("poise");
    app.set_version_flag("--version", "poise " POISE_VERSION, "Print the version");
    app.set_help_flag("-h,--help", "Print this help");
    app.require_subcommand(1);
    app.get_formatter()->label("SUBCOMMAND", "COMMAND");
    app.get_formatter()->label("Positionals", "Arguments");
    app.get_formatter()->label("REQUIRED", "");
    app.get_formatter()->label("Excludes", "not with");
    app.footer(
        "FILE is a grasp file (YAML or JSON), or - for standard input.\n"
        "Exit status: 0 it can be held, 1 it cannot be held, 2 bad input or usage,\n"
        "4 neither is proven; of verify: 0 confirmed, 1 refuted, 4 the result leaves it open;\n"
        "of batch: 0 all answered, 1 some grasps are bad.");
    for (const Subcommand* const command : all_commands) {
      flags.emplace_back(*app.add_subcommand(command->name, command->help)->group("Commands"));
      runs.push_back(command->declare(flags.back()));
    }
  }

  /// What to say about words that nothing was waiting for.
  void refuse_rest() const;
};

std::string full_name(const CLI::App& command) {
  return (command.get_parent() ? "poise " : "") + command.get_name();
}

/// "a, b or c"
std::string listed(const std::vector<std::string>& words, const std::string& last) {
  std::string list;
  for (std::size_t k = 0; k < words.size(); ++k)
    list += (k == 0 ? "" : k + 1 < words.size() ? ", " : last) + words[k];
  return list;
}

std::string options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* const option : command.get_options())
    if (!option->get_lnames().empty()) names.push_back("--" + option->get_lnames().front());
  return listed(names, ", ");
}

/// "one FILE and one RESULT"
std::string arguments_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* const option : command.get_options())
    if (option->get_positional()) names.push_back("one " + option->get_name(true));
  return listed(names, " and ");
}

void Parser::refuse_rest() const {
  const auto commands = app.get_subcommands();
  const bool before = commands.empty() || !app.remaining().empty();
  const CLI::App& command = before ? app : *commands.front();
  const std::vector<std::string> rest = command.remaining();
  if (rest.empty()) return;
  const auto option = std::find_if(rest.begin(), rest.end(),
                                   [](const auto& word) { return word.starts_with('-'); });
  const std::string& word = option != rest.end() ? *option : rest.front();
  if (word.starts_with('-'))
    throw UsageError("unknown option " + shown(word) + ", " + full_name(command) + " knows " +
                     options_of(command));
  if (before) {
    std::vector<std::string> names;
    for (const Subcommand* const known : all_commands) names.emplace_back(known->name);
    throw UsageError("unknown command " + in_quotes(word) + ", must be " + listed(names, " or "));
  }
  if (parsed_number(word))
    throw UsageError("unexpected " + in_quotes(word) +
                     ": numbers of one flag are written with commas and no blanks, like 0,0,1");
  throw UsageError("unexpected " + in_quotes(word) + ", " + full_name(command) + " takes " +
                   arguments_of(command));
}

}  // namespace

std::variant<Run, std::string> read_command_line(int argc, const char* const* argv) {
  Parser parser;
  // For packaging; no flag that help would show.
  if (argc == 2 && std::string_view(argv[1]) == "--completion")
    return completion(parser.app, parser.flags);
  try {
    parser.app.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // help or version
    std::ostringstream text;
    parser.app.exit(asked, text, text);
    return text.str();
  } catch (const CLI::ParseError& error) {
    parser.refuse_rest();
    throw UsageError(std::string(error.what()) + ", see poise --help");
  }
  for (std::size_t k = 0; k < parser.runs.size(); ++k)
    if (parser.app.get_subcommands().front() == &parser.flags[k].app()) {
      parser.flags[k].read();
      return parser.runs[k];
    }
  throw std::logic_error("a command that is not in the list");
}

}  // namespace poise
