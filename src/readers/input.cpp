#include "readers/input.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <fstream>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>

namespace poise {
namespace {

/// Of the files of the file system that were read in this run: a file may have many names.
class Inputs {
 public:
  void add(const struct stat& file) {
    const std::lock_guard lock(mutex_);
    files_.emplace(file.st_dev, file.st_ino);
  }
  bool has(const struct stat& file) {
    const std::lock_guard lock(mutex_);
    return files_.contains({file.st_dev, file.st_ino});
  }

 private:
  std::mutex mutex_;
  std::set<std::pair<dev_t, ino_t>> files_;
};

Inputs& inputs() {
  static Inputs inputs;
  return inputs;
}

}  // namespace

void check_input(const std::string& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0)
    throw ReadError(errno == ENOENT || errno == ENOTDIR
                        ? "does not exist"
                        : "cannot be opened: " + std::generic_category().message(errno));
  if (S_ISDIR(status.st_mode)) throw ReadError("is a folder, must be a file");
  if (!S_ISREG(status.st_mode)) throw ReadError("is not a regular file");
  inputs().add(status);
}

void note_input(const std::string& file) {
  struct stat status {};
  if ((file == "-" ? fstat(0, &status) : stat(file.c_str(), &status)) == 0 &&
      S_ISREG(status.st_mode))
    inputs().add(status);
}

bool is_input(const std::string& path) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0 && inputs().has(status);
}

std::string read_input(const std::string& file) {
  constexpr std::size_t most = std::size_t{1} << 30;
  check_input(file);
  errno = 0;
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in) throw ReadError("cannot be opened: " + std::generic_category().message(errno));
  const auto size = static_cast<std::size_t>(in.tellg());
  if (size > most) throw ReadError("is larger than 1 GiB, the most that is read");
  std::string bytes(size, '\0');
  in.seekg(0);
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  if (in.bad()) throw ReadError("cannot be read");
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  if (bytes.starts_with("version https://git-lfs.github.com/spec/"))
    throw ReadError("is a pointer of Git LFS, not the file: git lfs pull gets that");
  return bytes;
}

bool has_ending(const std::string& file, std::string_view ending) {
  return file.size() >= ending.size() &&
         std::equal(ending.begin(), ending.end(),
                    file.end() - static_cast<std::ptrdiff_t>(ending.size()),
                    [](char a, unsigned char b) { return a == std::tolower(b); });
}

}  // namespace poise
