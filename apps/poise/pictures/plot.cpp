#include "pictures/plot.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

extern char** environ;  // NOLINT(readability-redundant-declaration)

namespace poise {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& what, int error) {
  throw OutputError(path + ": " + what + ": " + std::generic_category().message(error));
}

/// A file beside the target that becomes the target, or vanishes.
class Draft {
 public:
  explicit Draft(std::string target)
      : target_(std::move(target)), path_(target_ + "." + std::to_string(getpid()) + ".part") {
    file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file_ < 0) fail(target_, "cannot be written", errno);
  }
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;
  ~Draft() {
    if (file_ >= 0) close(file_);
    unlink(path_.c_str());
  }

  int file() const { return file_; }

  /// Whether all of it arrived.
  bool write(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t written = ::write(file_, text.data(), text.size());
      if (written < 0 && errno != EINTR) return false;
      text.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
    }
    return true;
  }

  /// Whether the end has arrived: gnuplot does not mind a full disk.
  bool is_whole() const {
    char end[16] = {};
    const off_t size = lseek(file_, 0, SEEK_END), part = sizeof end;
    return size > part && pread(file_, end, sizeof end, size - part) == part &&
           (std::string_view(end, sizeof end).find("</svg>") != std::string_view::npos ||
            std::string_view(end, sizeof end).find("IEND") != std::string_view::npos);
  }

  void publish() {
    if (close(std::exchange(file_, -1)) != 0 || std::rename(path_.c_str(), target_.c_str()) != 0)
      fail(target_, "cannot be written", errno);
  }

 private:
  std::string target_, path_;
  int file_{-1};
};

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

/// The file to write to: a link stays a link.
std::string target_of(const std::string& path) {
  std::error_code none;
  if (!fs::exists(path, none)) return path;
  if (!fs::is_regular_file(path, none)) throw OutputError(path + ": is not a file to write to");
  return fs::canonical(path, none).string();
}

}  // namespace

void write_file(const std::string& text, const std::string& path) {
  Draft draft(target_of(path));
  if (!draft.write(text)) fail(path, "cannot be written", errno);
  draft.publish();
}

void draw(const std::string& script, const std::string& path) {
  const std::string target = target_of(path);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::tmpfile(), std::fclose);
  if (!in || std::fwrite(script.data(), 1, script.size(), in.get()) != script.size() ||
      std::fflush(in.get()) != 0)
    throw OutputError("cannot write a temporary file: " + std::generic_category().message(errno));
  std::rewind(in.get());

  Draft draft(target);
  if (run_gnuplot(fileno(in.get()), draft.file()) != 0)
    throw OutputError(path + ": gnuplot could not draw it");
  if (!draft.is_whole()) throw OutputError(path + ": cannot be written whole");
  draft.publish();
}

}  // namespace poise
