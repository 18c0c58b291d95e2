#include <dlfcn.h>

#include <algorithm>
#include <string_view>

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

/// The reader of robot models calls itself for each element within another. Where it is not clear
/// whether an element ends with its tag, it counts as one that does not.
void check_depth(const std::string& xml) {
  constexpr int most = 1000;
  int depth = 0;
  for (std::size_t at = 0; (at = xml.find('<', at)) != std::string::npos;) {
    const char* const close = xml.compare(at, 4, "<!--") == 0        ? "-->"
                              : xml.compare(at, 9, "<![CDATA[") == 0 ? "]]>"
                                                                     : ">";
    const std::size_t end = std::min(xml.find(close, at), xml.size());
    const std::string_view tag = std::string_view(xml).substr(at, end - at);
    const char first = tag.size() > 1 ? tag[1] : ' ';
    const bool quoted = std::count(tag.begin(), tag.end(), '"') % 2 != 0 ||
                        std::count(tag.begin(), tag.end(), '\'') % 2 != 0;
    if (first == '/')
      depth = std::max(depth - 1, 0);
    else if (first != '!' && first != '?' && (quoted || !tag.ends_with('/')) && ++depth > most)
      throw ReadError("is nested too deeply for a robot model");
    at = end;
  }
}

const MeshModule& mesh_module() { return loaded<MeshModule>("libpoise-mesh.so"); }
const DataModule& data_module() { return loaded<DataModule>("libpoise-data.so"); }

}  // namespace

std::unique_ptr<TriangleFinder> triangle_finder(const Mesh& mesh) {
  return mesh_module().finder(mesh);
}

Inertial read_inertial(const std::string& urdf, const std::string& link) {
  const std::string xml = read_input(urdf);
  check_depth(xml);
  return mesh_module().inertial(xml, link);
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
