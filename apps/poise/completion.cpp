#include "completion.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>

namespace poise {
namespace {

constexpr const char* functions = R"bash(
_poise_offer() {  # words WORD..., files SUFFIX|SUFFIX (and folders), or folders
  [[ $1 == words ]] || compopt -o filenames 2> /dev/null
  mapfile -t COMPREPLY < <(
    case $1 in
      words) compgen -W "${*:2}" -- "$word" ;;
      files)
        compgen -d -- "$word"
        shopt -s extglob
        compgen -f -X "!*.@($2)" -- "$word"
        ;;
      folders) compgen -d -- "$word" ;;
    esac
  )
}

_poise() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=poise takes k
  COMPREPLY=()
  for ((k = 1; k < COMP_CWORD; ++k)); do
    [[ ${COMP_WORDS[k]} == -* ]] || { command=${COMP_WORDS[k]}; break; }
  done
  takes=${_poise_takes[$command $before]-}
  if [[ -z $takes && $word == -* ]]; then
    takes="words ${_poise_flags[$command]-}"
  elif [[ -z $takes && $before == "$command" ]]; then
    takes=${_poise_takes[$command first]-}
  fi
  _poise_offer ${takes:-${_poise_takes[$command]-words}}
}

complete -F _poise poise
)bash";

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// What is offered after a flag whose value is of this type.
std::string offered(std::string type) {
  if (type == "DIR") return "folders";
  if (type == "FILE") return "files yaml|yml|json";
  for (const char* const files : {"SVG", "PNG", "JSONL", "H5", "HTML"})
    if (type.starts_with(files)) return "files " + lower(type);
  const bool words = type == lower(type);
  std::replace(type.begin(), type.end(), '|', ' ');
  return words ? "words " + type : "words";  // of numbers, none
}

/// All spellings of a flag; none of an argument.
std::vector<std::string> spellings(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

std::string flags_of(const CLI::App& command) {
  std::string list;
  for (const CLI::Option* const option : command.get_options())
    for (const std::string& name : spellings(*option)) list += (list.empty() ? "" : " ") + name;
  return list;
}

std::string entry(const std::string& key, const std::string& value) {
  return "  ['" + key + "']='" + value + "'\n";
}

}  // namespace

std::string completion(const CLI::App& program, const std::deque<Flags>& commands) {
  std::string names, flags = entry("poise", flags_of(program)), takes;
  for (const Flags& command : commands) {
    const std::string name = command.app().get_name();
    names += " " + name;
    flags += entry(name, flags_of(command.app()));
    takes += entry(name, command.takes().back());
    if (command.takes().size() > 1) takes += entry(name + " first", command.takes().front());
    for (const CLI::Option* const option : command.app().get_options())
      if (option->get_items_expected() > 0)  // it has a value
        for (const std::string& flag : spellings(*option))
          takes += entry(name + " " + flag, offered(option->get_type_name()));
  }
  takes += entry("poise", "words" + names);
  return "# Completion of poise for bash: commands, flags, and the files and words that they "
         "take.\n"
         "declare -gA _poise_flags=(\n" +
         flags + ")\ndeclare -gA _poise_takes=(\n" + takes + ")\n" + functions;
}

}  // namespace poise
