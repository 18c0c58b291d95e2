// Prints a grasp file as JSON: for the page, which has the examples inside. Of one whose shape is a
// mesh, which the page does not read: {"grasp", "mesh": to draw}.
#include <cstdio>
#include <string>

#include "files/grasp_writer.hpp"

namespace poise {
namespace {

std::string text(const PlanarFile& file) { return grasp_document(file); }

std::string text(SpatialFile file) {
  const auto* shape = file.shape ? std::get_if<MeshShape>(&*file.shape) : nullptr;
  if (shape == nullptr) return grasp_document(file);
  const std::string mesh = mesh_document(*shape->mesh);
  file.shape.reset();
  return "{\"grasp\": " + grasp_document(file) + ", \"mesh\": " + mesh + "}\n";
}

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    std::visit([](const auto& file) { std::fputs(poise::text(file).c_str(), stdout); },
               poise::read_grasp_file(argv[1]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
