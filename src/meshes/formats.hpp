// Files of meshes as bytes: a reader for each format. Damaged or hostile bytes end in a ReadError,
// in time and memory that are in proportion to their number.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "shape/mesh.hpp"

namespace poise {

/// A file that cannot be read; what() says why, without its name: "is a folder, must be a file".
class ReadError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The most vertices, and the most triangles, that are read of a file.
inline constexpr std::size_t most_triangles = 20'000'000;

// The triangles as they stand in the file, in its unit, polygons cut into triangles. Vertices may
// stand more than once, and may not be finite.
// @throws ReadError

/// Text or binary.
Mesh read_stl(std::string_view bytes);
/// Polygons and triangle strips; text or binary of either byte order.
Mesh read_ply(std::string_view bytes);
/// Polygons. Nothing that the file names is opened.
Mesh read_obj(std::string_view bytes);
/// glTF 2.0, .gltf or .glb: the meshes of its scene, where its nodes put them.
/// @param named  the bytes of a file that the mesh names, by its path as seen from the mesh
Mesh read_gltf(std::string_view bytes, const std::function<std::string(const std::string&)>& named);

}  // namespace poise
