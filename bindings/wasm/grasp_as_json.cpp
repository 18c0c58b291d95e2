// Prints a grasp file as JSON: for the page, which has the examples inside.
#include <cstdio>

#include "files/grasp_writer.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    std::visit([](const auto& file) { std::fputs(poise::grasp_document(file).c_str(), stdout); },
               poise::read_grasp_file(argv[1]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
