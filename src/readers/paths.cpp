#include <filesystem>

#include "readers/readers.hpp"

namespace poise {

namespace fs = std::filesystem;

std::string path_beside(const std::string& file, const std::string& path) {
  return (fs::path(file).parent_path() / path).string();
}

std::string path_from(const std::string& folder, const std::string& path) {
  return fs::proximate(path, folder).string();
}

}  // namespace poise
