#include "meshes/formats.hpp"
#include "meshes/polygons.hpp"
#include "meshes/words.hpp"

namespace poise {
namespace {

/// Lines that end with a backslash go on in the next one.
std::string joined(std::string_view bytes) {
  std::string text(bytes);
  for (std::size_t at = 0; (at = text.find('\\', at)) != std::string::npos; ++at) {
    const std::size_t end = text.compare(at + 1, 2, "\r\n") == 0 ? at + 2 : at + 1;
    if (end < text.size() && (text[end] == '\n' || text[end] == '\r'))
      text.replace(at, end + 1 - at, end + 1 - at, ' ');
  }
  return text;
}

Eigen::Vector3d read_vertex(Words& words) {
  Eigen::Vector3d vertex;
  for (double& x : vertex) {
    const auto number = number_of(words.in_line());
    if (!number) words.fail("has a vertex that is not three numbers");
    x = *number;
  }
  return vertex;
}

/// Corners are v, v/vt, v//vn or v/vt/vn, from 1, or below 0 from the last; only v counts here.
void read_face(Words& words, Polygons& polygons) {
  for (std::string_view word; !(word = words.in_line()).empty();) {
    if (word.starts_with('#')) break;
    const auto index = whole_of(word.substr(0, word.find('/')));
    if (!index || *index == 0) words.fail("has a face whose corners are no vertices");
    const long long vertex =
        *index > 0 ? *index - 1 : static_cast<long long>(polygons.vertices()) + *index;
    if (vertex < 0) words.fail("has a face that names a vertex that is not there");
    polygons.add_corner(vertex);
  }
  polygons.end_face();
}

}  // namespace

Mesh read_obj(std::string_view bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  const std::string text = joined(bytes);
  Polygons polygons;
  Words words(text);
  do {
    const std::string_view word = words.in_line();
    if (word == "v") {
      polygons.add_vertex(read_vertex(words));
    } else if (word == "f" || word == "fo") {
      read_face(words, polygons);
    } else if (word == "curv" || word == "curv2" || word == "surf") {
      words.fail("has a free-form curve or surface (" + std::string(word) +
                 "), which is not read: export triangles");
    } else if (word == "call" || word == "csh") {
      words.fail("runs another file (" + std::string(word) + "), which is not done");
    }
  } while (words.next_line());
  return std::move(polygons).triangles();
}

}  // namespace poise
