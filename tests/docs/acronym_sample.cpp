// acronym_sample FOLDER: a data set for the listings, whose hands all meet the box.
#include "../acronym_sample.hpp"

int main(int, char** arguments) {
  const std::filesystem::path folder = arguments[1];
  std::filesystem::create_directories(folder / "grasps");
  poise::write_acronym_mesh(folder);
  poise::write_acronym(folder / "grasps/one.h5", {0, 0.005});
  poise::write_acronym(folder / "grasps/two.h5", {0.002});
}
