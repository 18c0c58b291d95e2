// Any bytes are a mesh or a ReadError, and what can be read can be mended. POISE_READ is the reader
// of one format.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "meshes/formats.hpp"

namespace poise {
namespace {

/// What a glTF names is there, and does not suffice.
[[maybe_unused]] Mesh read_gltf(std::string_view bytes) {
  return poise::read_gltf(bytes,
                          [](const std::string& path) { return path + std::string(200, '\1'); });
}

void try_to_read(std::string_view bytes) {
  const Mesh mesh = POISE_READ(bytes);
  for (const auto& triangle : mesh.triangles)
    for (const int vertex : triangle)
      if (vertex < 0 || static_cast<std::size_t>(vertex) >= mesh.vertices.size()) __builtin_trap();
  const double size = bounds(mesh).diagonal().norm();
  if (mesh.triangles.size() > 1000 || !std::isnormal(size * size)) return;
  const MendedMesh result = mended(mesh);
  if (result.defect.empty() && !(volume(result.mesh) > 0)) __builtin_trap();
}

}  // namespace
}  // namespace poise

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    poise::try_to_read({reinterpret_cast<const char*>(data), size});
  } catch (const poise::ReadError&) {  // NOLINT(bugprone-empty-catch)
  }
  return 0;
}
