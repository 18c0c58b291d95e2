#include <algorithm>
#include <filesystem>

#include "readers/input.hpp"
#include "readers/readers.hpp"
#include "shape/characters.hpp"

namespace poise {
namespace {

namespace fs = std::filesystem;

/// A file that a mesh names: in its folder or beneath, so that it reads nothing of others.
std::string named_by(const std::string& mesh, const std::string& path) {
  std::error_code none;
  const fs::path folder = fs::weakly_canonical(fs::absolute(mesh).parent_path(), none);
  const fs::path file = fs::weakly_canonical(folder / path, none);
  const auto end = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first;
  const std::string words = "names " + shown(path) + ", which ";
  if (path.empty() || path.find('\0') != std::string::npos || end != folder.end())
    throw ReadError(words + "is not in the folder of the mesh or beneath");
  try {
    return read_input(file.string());
  } catch (const ReadError& error) {
    throw ReadError(words + error.what());
  }
}

}  // namespace

Mesh read_mesh(const std::string& file) {
  check_input(file);
  Mesh mesh;
  if (has_ending(file, ".stl"))
    mesh = read_stl(read_input(file));
  else if (has_ending(file, ".ply"))
    mesh = read_ply(read_input(file));
  else if (has_ending(file, ".obj"))
    mesh = read_obj(read_input(file));
  else if (has_ending(file, ".gltf") || has_ending(file, ".glb"))
    mesh = read_gltf(read_input(file), [&](const auto& path) { return named_by(file, path); });
  else
    throw ReadError("is of no known kind, must be .stl, .obj, .ply, .gltf or .glb");
  for (const Eigen::Vector3d& vertex : mesh.vertices)
    if (!vertex.allFinite()) throw ReadError("has a vertex that is not finite");
  return mesh;
}

}  // namespace poise
