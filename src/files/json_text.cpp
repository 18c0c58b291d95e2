#include "files/json_text.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "shape/characters.hpp"

namespace poise {
namespace {

using Json = nlohmann::ordered_json;

/// The JSON text in one line; empty if it is too long for `width` characters.
std::string one_line(const Json& value, std::size_t width) {
  if (!value.is_structured()) return value.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string text = value.is_array() ? "[" : "{";
  for (auto part = value.begin(); part != value.end(); ++part) {
    if (part != value.begin()) text += ", ";
    if (value.is_object())
      text += Json(part.key()).dump(-1, ' ', false, Json::error_handler_t::replace) + ": ";
    const std::string inside = text.size() < width ? one_line(*part, width - text.size()) : "";
    if (inside.empty()) return "";
    text += inside;
  }
  text += value.is_array() ? "]" : "}";
  return text.size() <= width ? text : "";
}

/// The JSON text, broken into lines only where it would be too long for one.
void write(const Json& value, std::size_t indent, std::string& text) {
  constexpr std::size_t width = 120;
  const std::string line = one_line(value, indent < width ? width - indent : 1);
  if (!line.empty() || value.empty()) {
    text += line;
    return;
  }
  text += value.is_array() ? "[\n" : "{\n";
  for (auto part = value.begin(); part != value.end(); ++part) {
    if (part != value.begin()) text += ",\n";
    text.append(indent + 2, ' ');
    if (value.is_object())
      text += Json(part.key()).dump(-1, ' ', false, Json::error_handler_t::replace) + ": ";
    write(*part, indent + 2, text);
  }
  text += '\n' + std::string(indent, ' ') + (value.is_array() ? ']' : '}');
}

}  // namespace

std::string json_text(const Json& value) {
  std::string text;
  write(value, 0, text);
  return with_escapes(text) + '\n';
}

std::string with_escapes(const std::string& json) {
  std::string text;
  for (std::size_t at = 0; at < json.size();) {
    const std::size_t size = std::max<std::size_t>(character_size(json, at), 1);
    const std::string character = json.substr(at, size);
    if (is_unseen(json, at)) {
      const std::string escaped = Json(character).dump(-1, ' ', true);
      text.append(escaped, 1, escaped.size() - 2);  // without its quotes
    } else {
      text += character;
    }
    at += size;
  }
  return text;
}

}  // namespace poise
