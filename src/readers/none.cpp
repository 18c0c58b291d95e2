// In a web page there are no files, and what knows their names takes room.
#include "readers/readers.hpp"

namespace poise {
namespace {

[[noreturn]] void refuse() {
  throw ReadError("cannot be read here, where there are no files: use poise view");
}

}  // namespace

std::string path_beside(const std::string& /*file*/, const std::string& path) { return path; }

std::string path_from(const std::string& /*folder*/, const std::string& path) { return path; }

Mesh read_mesh(const std::string& /*file*/) { refuse(); }

std::unique_ptr<TriangleFinder> triangle_finder(const Mesh& /*mesh*/) { refuse(); }

Inertial read_inertial(const std::string& /*urdf*/, const std::string& /*link*/) { refuse(); }

AcronymData read_acronym(const std::string& /*file*/) { refuse(); }

}  // namespace poise
