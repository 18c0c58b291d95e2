#include "files/output.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include "readers/input.hpp"

namespace poise {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& problem) {
  throw FileError(path, {}, "", problem);
}

[[noreturn]] void fail_to_write(const std::string& path, int error) {
  fail(path, "cannot be written: " + std::generic_category().message(error));
}

/// An open file that is closed in any case.
class Open {
 public:
  explicit Open(int file) : file_(file) {}
  Open(const Open&) = delete;
  Open& operator=(const Open&) = delete;
  ~Open() {
    if (file_ >= 0) close(file_);
  }
  int get() const { return file_; }
  bool closed() { return close(std::exchange(file_, -1)) == 0; }

 private:
  int file_;
};

}  // namespace

Target target_of(const std::string& path) {
  std::error_code none;
  const fs::file_status status = fs::status(path, none);
  if (fs::is_directory(status)) fail(path, "is a folder, must be a file");
  if (fs::is_character_file(status) || fs::is_fifo(status)) return {path, true};
  const bool is_link = fs::is_symlink(fs::symlink_status(path, none));
  if (is_link && !fs::exists(status)) fail(path, "is a link to what is not there");
  if (fs::exists(status) && !fs::is_regular_file(status)) fail(path, "is not a file to write to");
  if (is_input(path)) fail(path, "is read by this command, must be another file");
  const std::string target = is_link ? fs::canonical(path).string() : path;
  if (path.empty()) fail_to_write(path, ENOENT);
  const fs::path folder = fs::absolute(target).parent_path();
  if (!fs::exists(folder, none)) fail_to_write(path, ENOENT);
  if (!fs::is_directory(folder, none)) fail_to_write(path, ENOTDIR);
  if (access(folder.c_str(), W_OK | X_OK) != 0) fail_to_write(path, errno);
  if (fs::exists(status) && access(target.c_str(), W_OK) != 0) fail_to_write(path, errno);
  return {target};
}

void write_file(const std::string& text, const std::string& path) {
  const Target target = target_of(path);
  if (target.is_stream) {
    Open stream(open_stream(path));
    if (!write_all(stream.get(), text) || !stream.closed()) fail_to_write(path, errno);
    return;
  }
  const std::string part = target.path + "." + std::to_string(getpid()) + ".part";
  Open draft(open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (draft.get() < 0) fail_to_write(path, errno);
  struct stat old {};  // its permissions stay
  const bool ready =
      (stat(target.path.c_str(), &old) != 0 || fchmod(draft.get(), old.st_mode & 07777) == 0) &&
      write_all(draft.get(), text) && draft.closed() &&
      std::rename(part.c_str(), target.path.c_str()) == 0;
  if (ready) return;
  const int error = errno;
  unlink(part.c_str());
  fail_to_write(path, error);
}

bool write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

int open_stream(const std::string& path) {
  // A pipe that nobody reads would have it wait for ever.
  const int file = open(path.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (file < 0) fail_to_write(path, errno);
  fcntl(file, F_SETFL, fcntl(file, F_GETFL) & ~O_NONBLOCK);
  return file;
}

}  // namespace poise
