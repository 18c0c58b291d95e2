// Values as they are written in JSON.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "poise/contact.hpp"

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

/// null where there is none.
inline Json json_value(const std::optional<Pad>& pad) {
  if (!pad) return {};
  Json points = Json::array();
  for (const Vector<3>& point : pad->points) points.push_back(json_value(point));
  return {{"points", std::move(points)},
          {"shares", pad->shares},
          {"axis", json_value(pad->axis)},
          {"reach", json_value(pad->reach)}};
}

}  // namespace poise
