// Any bytes are a grasp file or a FileError, and what can be read can be told.
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "files/grasp_file.hpp"
#include "files/result.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const auto read : {poise::grasp_from_yaml, poise::grasp_from_json}) {
    try {
      const poise::GraspFile file = read(text, "fuzz.yaml");
      const auto document = nlohmann::json::parse(poise::check_document(file, file.grasp()));
      if (!document.at("weight").is_number()) __builtin_trap();
    } catch (const poise::FileError&) {  // NOLINT(bugprone-empty-catch)
    }
  }
  return 0;
}
