#include <dlfcn.h>

#include "readers/input.hpp"
#include "readers/modules.hpp"

namespace poise {
namespace {

/// The table that a module exports. It is looked for where the run path of the program says.
template <class Module>
const Module& loaded(const char* file) {
  static const Module* const module = [&] {
    void* const library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    const void* const table = library ? dlsym(library, "poise_module") : nullptr;
    if (!table) throw ReadError(std::string("cannot be read: ") + dlerror());
    return static_cast<const Module*>(table);
  }();
  return *module;
}

const MeshModule& mesh_module() { return loaded<MeshModule>("libpoise-mesh.so"); }
const DataModule& data_module() { return loaded<DataModule>("libpoise-data.so"); }

}  // namespace

std::unique_ptr<TriangleFinder> triangle_finder(const Mesh& mesh) {
  return mesh_module().finder(mesh);
}

Inertial read_inertial(const std::string& urdf, const std::string& link) {
  check_input(urdf);
  return mesh_module().inertial(urdf, link);
}

AcronymData read_acronym(const std::string& file) {
  check_input(file);
  return data_module().acronym(file);
}

void add_arrays(const std::string& file, const std::string& group,
                const std::vector<NamedArray>& arrays) {
  data_module().add_arrays(file, group, arrays);
}

}  // namespace poise
