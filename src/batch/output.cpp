#include "batch/output.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "files/output.hpp"

namespace poise {
namespace {

namespace fs = std::filesystem;

/// What stands beside the output must not be what is read, a folder, or the like.
void check_beside(const std::string& path) {
  if (target_of(path).is_stream) throw FileError(path, {}, "", "is not a file to write to");
}

}  // namespace

Output::Output(std::string path, const std::string& run, bool resume,
               const std::function<void(const std::string&)>& seen)
    : path_(std::move(path)), name_(path_.empty() ? "standard output" : path_) {
  if (path_.empty()) return;
  const Target target = target_of(path_);
  path_ = target.is_stream ? "" : target.path;
  if (target.is_stream) {
    if (resume) throw FileError(name_, {}, "", "is not a file, which --resume needs");
    file_ = open_stream(name_);
    return;
  }
  part_ = path_ + ".part";
  run_ = path_ + ".run";
  check_beside(part_);
  check_beside(run_);
  if (resume && fs::exists(part_)) {
    resume_part(run, seen);
  } else if (resume && fs::exists(path_)) {
    finished_ = true;
    file_ = -1;
  } else {
    start(run);
  }
}

Output::~Output() {
  if (file_ > STDERR_FILENO) close(file_);
}

void Output::start(const std::string& run) {
  file_ = open(part_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file_ < 0 && errno == EEXIST)
    throw FileError(part_, {}, "",
                    "is a part of an unfinished run: continue it with --resume, or remove it");
  if (file_ < 0) fail("cannot be written", errno);
  flock(file_, LOCK_EX | LOCK_NB);
  std::ofstream note(run_, std::ios::binary);
  note << run;
  note.close();
  if (note) return;
  const int error = errno;
  discard();
  fail("cannot be written", error);
}

void Output::resume_part(const std::string& run,
                         const std::function<void(const std::string&)>& seen) {
  file_ = open(part_.c_str(), O_RDWR | O_CLOEXEC);
  if (file_ < 0) fail("cannot be written", errno);
  if (flock(file_, LOCK_EX | LOCK_NB) != 0)
    throw FileError(part_, {}, "", "is being written by another run");
  std::ostringstream before;
  before << std::ifstream(run_, std::ios::binary).rdbuf();
  if (before.str() != run && fs::file_size(part_) > 0)
    throw FileError(part_, {}, "",
                    "is a part of another run, whose input, options or version differ: it is "
                    "described in " +
                        run_ + "; remove it to start anew");
  if (before.str() != run) {  // it was killed before the first record
    close(file_);
    unlink(part_.c_str());
    return start(run);
  }
  std::ifstream part(part_, std::ios::binary);
  for (std::string line; std::getline(part, line) && !part.eof(); ++records_) {
    seen(line);
    bytes_ += static_cast<long long>(line.size()) + 1;
  }
  if (ftruncate(file_, bytes_) != 0 || lseek(file_, bytes_, SEEK_SET) < 0)  // a torn line
    fail("cannot be written", errno);
}

void Output::write(std::string_view line) {
  if (!write_all(file_, line)) {
    const int error = errno;
    if (path_.empty())
      throw FileError(name_, {}, "",
                      "cannot be written: " + std::generic_category().message(error));
    if (ftruncate(file_, bytes_) != 0) {  // --resume cuts it off
    }
    fail("cannot be continued after " + std::to_string(records_) +
             " records, make room and go on with --resume",
         error);
  }
  bytes_ += static_cast<long long>(line.size());
  ++records_;
}

void Output::finish() {
  if (path_.empty() || finished_) return;
  target_of(path_);  // by now it may have been read
  if (fsync(file_) != 0 || std::rename(part_.c_str(), path_.c_str()) != 0)
    fail("cannot be finished", errno);
  unlink(run_.c_str());
}

void Output::discard() {
  if (path_.empty()) return;
  unlink(part_.c_str());
  unlink(run_.c_str());
}

void Output::fail(const std::string& what, int error) const {
  throw FileError(part_, {}, "", what + ": " + std::generic_category().message(error));
}

}  // namespace poise
