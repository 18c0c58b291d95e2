// Prints a planar grasp file as JSON, for places where there is no YAML: the page and its tests.
#include <cstdio>

#include "files/grasp_writer.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    const poise::GraspFile file = poise::read_grasp_file(argv[1]);
    std::fputs(poise::grasp_document(std::get<poise::PlanarFile>(file)).c_str(), stdout);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
