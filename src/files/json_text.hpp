// JSON as it is printed.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace poise {

/// A JSON document in lines of readable length.
std::string json_text(const nlohmann::ordered_json& value);

}  // namespace poise
