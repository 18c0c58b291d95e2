// What is wrong with a file, and where.
#pragma once

#include <stdexcept>
#include <string>

namespace poise {

/// A place in a text, counted from 1, columns in characters; 0 stands for the file as a whole.
struct Place {
  int line{0}, column{0};
};

/// "FILE:LINE:COLUMN: path: problem", without the parts that are not known.
inline std::string located(const std::string& file, Place place, const std::string& path,
                           const std::string& problem) {
  std::string text = file + ":";
  if (place.line > 0) text += std::to_string(place.line) + ":" + std::to_string(place.column) + ":";
  return text + " " + (path.empty() ? "" : path + ": ") + problem;
}

/// A file that cannot be used.
class FileError : public std::runtime_error {
 public:
  FileError(const std::string& file, Place place, const std::string& path,
            const std::string& problem)
      : std::runtime_error(located(file, place, path, problem)),
        file_(file),
        place_(place),
        path_(path),
        problem_(problem) {}
  const std::string& file() const noexcept { return file_; }
  int line() const noexcept { return place_.line; }           ///< from 1; 0: the file as a whole
  int column() const noexcept { return place_.column; }       ///< from 1; 0: the file as a whole
  const std::string& path() const noexcept { return path_; }  ///< "contacts[1].friction"
  const std::string& problem() const noexcept { return problem_; }  ///< "is -1, must be at least 0"

 private:
  std::string file_;
  Place place_;
  std::string path_, problem_;
};

}  // namespace poise
