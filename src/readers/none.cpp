// In a web page there are no files.
#include "readers/readers.hpp"

namespace poise {
namespace {

[[noreturn]] void refuse() {
  throw ReadError("cannot be read here, where there are no files: use poise view");
}

}  // namespace

Mesh read_mesh(const std::string& /*file*/) { refuse(); }

std::unique_ptr<TriangleFinder> triangle_finder(const Mesh& /*mesh*/) { refuse(); }

Inertial read_inertial(const std::string& /*urdf*/, const std::string& /*link*/) { refuse(); }

AcronymData read_acronym(const std::string& /*file*/) { refuse(); }

}  // namespace poise
