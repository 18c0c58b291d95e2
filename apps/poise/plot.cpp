#include "plot.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

extern char** environ;  // NOLINT(readability-redundant-declaration)

namespace poise {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& what, int error) {
  throw PlotError(path + ": " + what + ": " + std::generic_category().message(error));
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

  /// Whether the end has arrived: gnuplot does not mind a full disk.
  bool is_whole() const {
    char end[16] = {};
    const off_t size = lseek(file_, 0, SEEK_END), part = sizeof end;
    return size > part && pread(file_, end, sizeof end, size - part) == part &&
           std::string_view(end, sizeof end).find("</svg>") != std::string_view::npos;
  }

  void publish() {
    if (close(std::exchange(file_, -1)) != 0 || std::rename(path_.c_str(), target_.c_str()) != 0)
      fail(target_, "cannot be written", errno);
  }

 private:
  std::string target_, path_;
  int file_{-1};
};

/// Runs gnuplot without the user's settings; its status as waitpid gives it.
int run_gnuplot(int in, int out) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
  char name[] = "gnuplot", settings[] = "--default-settings";
  char* const arguments[] = {name, settings, nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, name, &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT)
    throw PlotError("--plot needs gnuplot, which is not installed (Debian: gnuplot-nox)");
  if (error != 0) throw PlotError("cannot run gnuplot: " + std::generic_category().message(error));
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw PlotError("lost gnuplot");
  return status;
}

}  // namespace

void draw(const std::string& script, const std::string& path) {
  std::error_code none;
  std::string target = path;
  if (fs::exists(path, none)) {
    if (!fs::is_regular_file(path, none)) throw PlotError(path + ": is not a file to write to");
    target = fs::canonical(path, none).string();  // keeps a link a link
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::tmpfile(), std::fclose);
  if (!in || std::fwrite(script.data(), 1, script.size(), in.get()) != script.size() ||
      std::fflush(in.get()) != 0)
    throw PlotError("cannot write a temporary file: " + std::generic_category().message(errno));
  std::rewind(in.get());

  Draft draft(target);
  if (run_gnuplot(fileno(in.get()), draft.file()) != 0)
    throw PlotError(path + ": gnuplot could not draw it");
  if (!draft.is_whole()) throw PlotError(path + ": cannot be written whole");
  draft.publish();
}

}  // namespace poise
