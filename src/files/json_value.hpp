// Values as they are written in JSON.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "poise/wrench.hpp"

namespace poise {

using Json = nlohmann::ordered_json;

/// A number without the sign of zero; null where it is not finite.
inline Json json_value(double number) {
  return std::isfinite(number) ? Json(number == 0 ? 0 : number) : Json();
}
inline Json json_value(const std::string& text) { return text; }
template <int Size>
Json json_value(const Eigen::Matrix<double, Size, 1>& numbers) {
  Json result = Json::array();
  for (const double number : numbers) result.push_back(json_value(number));
  return result;
}

}  // namespace poise
