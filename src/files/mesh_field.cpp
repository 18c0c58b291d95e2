#include "files/mesh_field.hpp"

#include <cmath>
#include <filesystem>

#include "files/text.hpp"
#include "shape/number_text.hpp"

namespace poise {
namespace {

std::string path_from(const Field& field) {
  return (std::filesystem::path(field.file()).parent_path() / field.text()).string();
}

[[noreturn]] void fail(const Field& field, const std::string& problem) {
  field.fail(shown(field.text()) + " " + problem);
}

double read_scale(const Field& field) {
  const double scale = field.number();
  if (!(scale > 0)) field.fail("is " + number_text(scale) + ", must be above 0");
  return scale;
}

}  // namespace

MeshShape read_mesh_shape(const Field& field, double unit, std::vector<std::string>& warnings) {
  Field file = field;
  MeshShape shape{.scale = unit};
  if (!field.is_text()) {
    field.mapping({"file", "scale"});
    file = field.get("file", "a file");
    if (const auto scale = field.find("scale")) shape.scale = read_scale(*scale);
  }
  shape.file = path_from(file);
  MendedMesh mended;
  try {
    mended = poise::mended(read_mesh(shape.file));
  } catch (const ReadError& error) {
    fail(file, error.what());
  }
  if (mended.mesh.triangles.empty() || !bounds(mended.mesh).diagonal().allFinite())
    fail(file, mended.defect);
  for (Vector<3>& vertex : mended.mesh.vertices) vertex *= shape.scale;
  if (const double size = bounds(mended.mesh).diagonal().norm() / 2; !std::isnormal(size * size))
    fail(file, "has a size of " + number_text(size, 3) + " m, too " +
                   (size < 1 ? "small" : "large") + " to compute with");
  const auto warn = [&](const std::string& words) {
    warnings.push_back(
        located(file.file(), file.place(), file.path(), shown(file.text()) + " " + words));
  };
  for (const std::string& repair : mended.repairs) warn(repair);
  if (!mended.defect.empty())
    warn(mended.defect + "; so it has neither volume nor inside, but a surface to touch");
  shape.mesh = std::make_shared<const Mesh>(std::move(mended.mesh));
  shape.defect = std::move(mended.defect);
  return shape;
}

Inertial read_inertial(const Field& field) {
  field.mapping({"urdf", "link"});
  const Field urdf = field.get("urdf", "a file");
  const std::string link = field.get("link", "the name of a link").text();
  try {
    return read_inertial(path_from(urdf), link);
  } catch (const ReadError& error) {
    fail(urdf, error.what());
  }
}

}  // namespace poise
