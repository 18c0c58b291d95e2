#include "files/grasp_file.hpp"
#include "module.hpp"
#include "values.hpp"

namespace poise::python {
namespace {

py::object write(const Shape& shape) {
  if (const auto* disk = std::get_if<Disk>(&shape)) return type("Disk")(disk->radius);
  if (const auto* ellipse = std::get_if<Ellipse>(&shape)) return type("Ellipse")(ellipse->radii);
  return type("Polygon")(std::get<Polygon>(shape).vertices);
}

py::object write(const PlanarFile& file) {
  using namespace py::literals;  // NOLINT(google-build-using-namespace): _a
  return py::module_::import("poise._files")
      .attr("GraspFile")(
          python::write(file.object), python::write(file.contacts), "name"_a = file.name,
          "safety"_a = file.safety, "angle"_a = file.angle, "domain"_a = file.domain,
          "shape"_a = file.shape ? write(*file.shape) : py::none(), "warnings"_a = file.warnings);
}

/// @param name  of the file in messages
py::object write(const GraspFile& file, const std::string& name) {
  if (const auto* planar = std::get_if<PlanarFile>(&file)) return write(*planar);
  throw FileError(name, {}, "dimension", "is 3, must be 2: Python knows the plane alone");
}

}  // namespace

void add_files(py::module_& module) {
  module.def(
      "read_grasp_file", [](const std::string& file) { return write(read_grasp_file(file), file); },
      py::arg("file"), "Reads a grasp file, YAML or JSON; \"-\" is standard input.");
  module.def(
      "grasp_from_yaml",
      [](const std::string& text, const std::string& file) {
        return write(grasp_from_yaml(text, file), file);
      },
      py::arg("text"), py::arg("file"),
      "Reads a text, YAML or JSON; file is its name in messages.");
}

}  // namespace poise::python
