// JSON as it is printed.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace poise {

/// A JSON document in lines of readable length.
std::string json_text(const nlohmann::ordered_json& value);

/// The same JSON, with characters that are not seen as \uXXXX.
std::string with_escapes(const std::string& json);

}  // namespace poise
