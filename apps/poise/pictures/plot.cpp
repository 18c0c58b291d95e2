#include "pictures/plot.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <string_view>
#include <system_error>
#include <vector>

extern char** environ;  // NOLINT(readability-redundant-declaration)

namespace poise {
namespace {

/// The environment of this process in a locale that has all characters: in the C locale gnuplot
/// complains about the degree sign.
std::vector<char*> environment_in_utf8() {
  static char locale[] = "LC_ALL=C.UTF-8";
  std::vector<char*> variables{locale};
  for (char** variable = environ; *variable != nullptr; ++variable)
    if (!std::string_view(*variable).starts_with("LC_ALL=")) variables.push_back(*variable);
  variables.push_back(nullptr);
  return variables;
}

/// Runs gnuplot without the user's settings and locale; its status as waitpid gives it.
int run_gnuplot(int in, int out) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
  char name[] = "gnuplot", settings[] = "--default-settings";
  char* const arguments[] = {name, settings, nullptr};
  pid_t child = 0;
  const int error =
      posix_spawnp(&child, name, &actions, nullptr, arguments, environment_in_utf8().data());
  posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT)
    throw OutputError("drawing needs gnuplot, which is not installed (Debian: gnuplot-nox)");
  if (error != 0)
    throw OutputError("cannot run gnuplot: " + std::generic_category().message(error));
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw OutputError("lost gnuplot");
  return status;
}

/// The whole of a temporary file.
std::string text_of(std::FILE* file) {
  std::string text;
  std::rewind(file);
  char part[4096];
  while (const std::size_t size = std::fread(part, 1, sizeof part, file)) text.append(part, size);
  return text;
}

/// Gnuplot leaves a > in names as it is, which ]]> may not have in XML.
std::string with_entities(const std::string& svg) {
  std::string text;
  for (std::size_t at = 0; at < svg.size();) {
    const bool markup = svg[at] == '<';
    const char* const close = svg.compare(at, 9, "<![CDATA[") == 0 ? "]]>"
                              : svg.compare(at, 4, "<!--") == 0    ? "-->"
                                                                   : ">";
    const std::size_t end = markup ? svg.find(close, at) : svg.find('<', at);
    const std::size_t next = end == std::string::npos ? svg.size()
                             : markup                 ? end + std::string_view(close).size()
                                                      : end;
    for (; at < next; ++at) text += !markup && svg[at] == '>' ? "&gt;" : std::string(1, svg[at]);
  }
  return text;
}

}  // namespace

void draw(const std::string& script, const std::string& path) {
  target_of(path);
  using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
  const File in(std::tmpfile(), std::fclose), out(std::tmpfile(), std::fclose);
  if (!in || !out || std::fwrite(script.data(), 1, script.size(), in.get()) != script.size() ||
      std::fflush(in.get()) != 0)
    throw OutputError("cannot write a temporary file: " + std::generic_category().message(errno));
  std::rewind(in.get());
  if (run_gnuplot(fileno(in.get()), fileno(out.get())) != 0)
    throw OutputError(path + ": gnuplot could not draw it");
  const std::string drawing = text_of(out.get());
  // Gnuplot does not mind a full disk.
  const std::string_view end =
      std::string_view(drawing).substr(drawing.size() - std::min<std::size_t>(drawing.size(), 16));
  const bool svg = end.find("</svg>") != std::string_view::npos;
  if (!svg && end.find("IEND") == std::string_view::npos)
    throw OutputError(path + ": cannot be written whole");
  write_file(svg ? with_entities(drawing) : drawing, path);
}

}  // namespace poise
