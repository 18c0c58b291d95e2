#include <algorithm>

#include "meshes/formats.hpp"
#include "meshes/numbers.hpp"
#include "meshes/words.hpp"

namespace poise {
namespace {

using Eigen::Vector3d;

constexpr std::size_t head = 84, record = 50;  // bytes of a binary file before, and for a triangle

void add(Mesh& mesh, const std::array<Vector3d, 3>& corners) {
  if (mesh.triangles.size() == most_triangles)
    throw ReadError("has more than " + std::to_string(most_triangles) +
                    " triangles, the most that is read");
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
  mesh.triangles.push_back({first, first + 1, first + 2});
}

Mesh read_binary(std::string_view bytes, std::size_t count) {
  Mesh mesh;
  for (std::size_t t = 0; t < count; ++t) {
    const char* const at = bytes.data() + head + t * record + 12;  // after the normal
    std::array<Vector3d, 3> corners;
    for (std::size_t k = 0; k < 9; ++k)
      corners[k / 3][static_cast<Eigen::Index>(k % 3)] = number_at(at + 4 * k, NumberType::float32);
    add(mesh, corners);
  }
  return mesh;
}

/// What a text begins with is also how many binary files do: a facet or the end must follow.
bool is_text(std::string_view bytes) {
  Words words(bytes);
  if (!same_word(words.anywhere(), "solid")) return false;
  words.next_line();
  const std::string_view next = words.anywhere();
  return (next.empty() && bytes.find('\0') == std::string_view::npos) || same_word(next, "facet") ||
         same_word(next, "endsolid");
}

/// Capital letters are as good. The normals are not needed, whatever they are.
Mesh read_text(std::string_view bytes) {
  Mesh mesh;
  Words words(bytes);
  const auto want = [&](const char* word) {
    if (!same_word(words.anywhere(), word))
      words.fail(std::string("is no part of an STL: ") + word + " expected");
  };
  for (std::string_view word; !(word = words.anywhere()).empty();) {
    if (same_word(word, "solid") || same_word(word, "endsolid")) {
      words.next_line();
      continue;
    }
    if (!same_word(word, "facet")) words.fail("is no part of an STL: facet or endsolid expected");
    want("normal");
    for (int k = 0; k < 3; ++k) words.anywhere();
    want("outer");
    want("loop");
    std::array<Vector3d, 3> corners;
    for (Vector3d& corner : corners) {
      want("vertex");
      for (double& x : corner) {
        const auto number = number_of(words.anywhere());
        if (!number) words.fail("has a vertex that is not three numbers");
        x = *number;
      }
    }
    want("endloop");
    want("endfacet");
    add(mesh, corners);
  }
  return mesh;
}

}  // namespace

Mesh read_stl(std::string_view bytes) {
  const std::size_t room = bytes.size() < head ? 0 : (bytes.size() - head) / record;
  const std::size_t count =
      bytes.size() < head
          ? 0
          : static_cast<std::size_t>(number_at(bytes.data() + head - 4, NumberType::uint32));
  if (bytes.size() >= head && bytes.size() == head + count * record)
    return read_binary(bytes, count);
  if (is_text(bytes)) return read_text(bytes);
  if (bytes.size() < head)
    throw ReadError("cannot be read: is no STL, neither text nor long enough for a binary one");
  if (count > room || count == 0)
    throw ReadError("cannot be read: says that it has " + std::to_string(count) +
                    " triangles, but is as long as " + std::to_string(room));
  return read_binary(bytes, count);  // what follows is not ours
}

}  // namespace poise
