// Records as they are written: in order, whole lines, to be continued after any end.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace poise {

/// Standard output, a device or a pipe, or a file. The file grows as FILE.part and gets its name
/// when it is whole; beside it FILE.run tells what is being done.
class Output {
 public:
  /// @param path  "" for standard output
  /// @param run   what is being done: a part is only continued by the same
  /// @param seen  is called with each record that is there already
  /// @throws FileError for a file that cannot be written (files/output.hpp), for a part where none
  /// is to be
  ///         continued, and for a part of another run
  Output(std::string path, const std::string& run, bool resume,
         const std::function<void(const std::string&)>& seen);
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  ~Output();

  /// How many records are there already.
  std::size_t records() const { return records_; }
  /// Where they are until then.
  const std::string& part() const { return part_; }
  /// Whether the file is there and whole: nothing is left to do.
  bool finished() const { return finished_; }
  /// Adds a line. @throws FileError where it does not fit; the records before it stay usable.
  void write(std::string_view line);
  /// Gives the file its name. @throws FileError
  void finish();
  /// Leaves nothing.
  void discard();

 private:
  void resume_part(const std::string& run, const std::function<void(const std::string&)>& seen);
  void start(const std::string& run);
  [[noreturn]] void fail(const std::string& what, int error) const;

  std::string path_, name_, part_, run_;
  int file_{1};
  long long bytes_{0};  ///< in whole lines
  std::size_t records_{0};
  bool finished_{false};
};

}  // namespace poise
