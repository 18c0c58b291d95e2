#include "files/mesh_field.hpp"

#include <cmath>

#include "files/text.hpp"
#include "shape/number_text.hpp"

namespace poise {
namespace {

[[noreturn]] void fail(const Field& field, const std::string& problem) {
  field.fail(shown(field.text()) + " " + problem);
}

}  // namespace

MeshShape mesh_shape(const std::string& file, double scale, std::vector<std::string>& notes) {
  const auto check_size = [](const Mesh& mesh) {
    const double size = bounds(mesh).diagonal().stableNorm() / 2;
    if (!std::isnormal(size * size))
      throw ReadError("has a size of " + number_text(size, 3) + " m, too " +
                      (size < 1 ? "small" : "large") + " to compute with");
  };
  const Mesh mesh = read_mesh(file);
  if (mesh.triangles.empty()) throw ReadError("has no triangles");
  check_size(mesh);
  MendedMesh mended = poise::mended(mesh);
  if (mended.mesh.triangles.empty()) throw ReadError(mended.defect);
  for (Vector<3>& vertex : mended.mesh.vertices) vertex *= scale;
  check_size(mended.mesh);
  notes = std::move(mended.repairs);
  if (!mended.defect.empty())
    notes.push_back(mended.defect +
                    "; so it has neither volume nor inside, but a surface to touch");
  return {std::make_shared<const Mesh>(std::move(mended.mesh)), std::move(mended.defect), file,
          scale};
}

MeshShape read_mesh_shape(const Field& field, double unit, std::vector<std::string>& warnings) {
  Field file = field;
  double scale = unit;
  if (!field.is_text()) {
    field.mapping({"file", "scale"});
    file = field.get("file", "a file");
    if (const auto given = field.find("scale")) scale = given->above_zero();
  }
  try {
    std::vector<std::string> notes;
    MeshShape shape = mesh_shape(path_beside(file.file(), file.text()), scale, notes);
    for (const std::string& note : notes)
      warnings.push_back(
          located(file.file(), file.place(), file.path(), shown(file.text()) + " " + note));
    return shape;
  } catch (const ReadError& error) {
    fail(file, error.what());
  }
}

Inertial read_inertial(const Field& field) {
  field.mapping({"urdf", "link"});
  const Field urdf = field.get("urdf", "a file");
  const std::string link = field.get("link", "the name of a link").text();
  try {
    return read_inertial(path_beside(urdf.file(), urdf.text()), link);
  } catch (const ReadError& error) {
    fail(urdf, error.what());
  }
}

}  // namespace poise
