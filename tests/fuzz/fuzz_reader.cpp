// Any bytes are a grasp file or a FileError, and what can be read can be told.
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "ask/document.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const auto read : {poise::grasp_from_yaml, poise::grasp_from_json}) {
    try {
      const poise::GraspFile file = read(text, "fuzz.yaml");
      const std::string told = std::visit(
          []<int Dim>(const poise::CommonFile<Dim>& any) {
            return poise::document<Dim>(static_cast<const poise::FileOf<Dim>&>(any), any.grasp(),
                                        poise::CheckAnswer<Dim>());
          },
          file);
      if (!nlohmann::json::parse(told).at("contacts").is_array()) __builtin_trap();
    } catch (const poise::FileError&) {  // NOLINT(bugprone-empty-catch)
    }
  }
  return 0;
}
