#include "files.hpp"

#include "files/grasp_writer.hpp"
#include "module.hpp"
#include "values.hpp"

namespace poise::python {
namespace {

py::object write(const Disk& disk) { return type("Disk")(disk.radius); }
py::object write(const Ellipse& ellipse) { return type("Ellipse")(ellipse.radii); }
py::object write(const Polygon& polygon) { return type("Polygon")(polygon.vertices); }
py::object write(const Box& box) { return type("Box")(box.size); }
py::object write(const Cylinder& cylinder) {
  return type("Cylinder")(cylinder.radius, cylinder.height);
}
py::object write(const Sphere& sphere) { return type("Sphere")(sphere.radius); }
py::object write(const Ellipsoid& ellipsoid) { return type("Ellipsoid")(ellipsoid.radii); }

py::object write(const MeshShape& mesh) { return type("MeshShape")(mesh.file, mesh.scale); }

template <int Dim>
py::object write_common(const CommonFile<Dim>& file) {
  using namespace py::literals;  // NOLINT(google-build-using-namespace): _a
  py::object result =
      py::module_::import("poise._files")
          .attr("GraspFile")(python::write(file.loads), python::write(file.contacts),
                             "name"_a = file.name, "safety"_a = file.safety,
                             "warnings"_a = file.warnings, "objective"_a = file.objective);
  const py::dict keys =
      py::module_::import("json").attr("loads")(mechanism_document(file.mechanism));
  result.attr("drives") = keys.attr("get")("drives");
  result.attr("fingers") = keys.attr("get")("fingers");
  if (file.shape)
    result.attr("shape") = std::visit([](const auto& shape) { return write(shape); }, *file.shape);
  return result;
}

py::object write(const PlanarFile& file) {
  py::object result = write_common<2>(file);
  result.attr("angle") = file.angle;
  result.attr("domain") = file.domain;
  return result;
}

py::object write(const SpatialFile& file) {
  py::object result = write_common<3>(file);
  result.attr("up") = file.up;
  if (file.tilt) result.attr("tilt") = type("Tilt")(file.tilt->from, file.tilt->most);
  return result;
}

}  // namespace

py::object write(const GraspFile& file) {
  return std::visit([](const auto& either) { return write(either); }, file);
}

void add_files(py::module_& module) {
  module.def(
      "_read_grasp_file", [](const std::string& file) { return write(read_grasp_file(file)); },
      py::arg("file"), "Reads a grasp file, YAML or JSON; \"-\" is standard input.");
  module.def(
      "_grasp_from_yaml",
      [](const std::string& text, const std::string& file) {
        return write(grasp_from_yaml(text, file));
      },
      py::arg("text"), py::arg("file"),
      "Reads a text, YAML or JSON; file is its name in messages.");
}

}  // namespace poise::python
