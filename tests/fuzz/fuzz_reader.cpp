// Any bytes are a grasp file or a FileError, and what can be read can be told.
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "files/grasp_file.hpp"
#include "files/result.hpp"

namespace {

poise::Grasp<2> grasps(const poise::PlanarFile& file) { return file.grasp(); }
std::vector<poise::Grasp<3>> grasps(const poise::SpatialFile& file) { return file.grasps(); }

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const auto read : {poise::grasp_from_yaml, poise::grasp_from_json}) {
    try {
      const poise::GraspFile file = read(text, "fuzz.yaml");
      const std::string told =
          std::visit([](const auto& any) { return check_document(any, grasps(any)); }, file);
      if (!nlohmann::json::parse(told).at("contacts").is_array()) __builtin_trap();
    } catch (const poise::FileError&) {  // NOLINT(bugprone-empty-catch)
    }
  }
  return 0;
}
