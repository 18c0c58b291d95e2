#include "files/value.hpp"

#include <algorithm>
#include <clocale>
#include <cstdlib>
#include <limits>
#include <optional>

#include "files/text.hpp"

namespace poise {
namespace {

constexpr std::string_view decimal = "0123456789";

/// Whether all of a text consists of these characters, and there are some.
bool all_of(std::string_view text, std::string_view characters) {
  return !text.empty() && text.find_first_not_of(characters) == std::string_view::npos;
}

bool any_of(std::string_view text, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), text) != words.end();
}

/// The value of decimal digits with an optional point and exponent, in any locale.
double decimal_value(std::string_view text) {
  std::string digits(text);
  if (const auto point = digits.find('.'); point != std::string::npos)
    digits.replace(point, 1, std::localeconv()->decimal_point);
  return std::strtod(digits.c_str(), nullptr);
}

double based_value(std::string_view digits, int base) {
  double value = 0;
  for (const char c : digits) value = value * base + (c <= '9' ? c - '0' : (c | 0x20) - 'a' + 10);
  return value;
}

/// YAML 1.2, section 10.3.2.
std::optional<double> number(std::string_view text) {
  if (text.substr(0, 2) == "0x" && all_of(text.substr(2), "0123456789abcdefABCDEF"))
    return based_value(text.substr(2), 16);
  if (text.substr(0, 2) == "0o" && all_of(text.substr(2), "01234567"))
    return based_value(text.substr(2), 8);
  if (any_of(text, {".nan", ".NaN", ".NAN"})) return std::numeric_limits<double>::quiet_NaN();

  const double sign = text.substr(0, 1) == "-" ? -1 : 1;
  if (any_of(text.substr(0, 1), {"-", "+"})) text.remove_prefix(1);
  if (any_of(text, {".inf", ".Inf", ".INF"})) return sign * std::numeric_limits<double>::infinity();

  std::string_view mantissa = text;
  if (const auto e = text.find_first_of("eE"); e != std::string_view::npos) {
    mantissa = text.substr(0, e);
    std::string_view exponent = text.substr(e + 1);
    if (any_of(exponent.substr(0, 1), {"-", "+"})) exponent.remove_prefix(1);
    if (!all_of(exponent, decimal)) return {};
  }
  const auto point = mantissa.find('.');
  const std::string_view whole = mantissa.substr(0, point);
  const std::string_view part =
      point == std::string_view::npos ? std::string_view() : mantissa.substr(point + 1);
  if (whole.empty() ? !all_of(part, decimal)
                    : !all_of(whole, decimal) || (!part.empty() && !all_of(part, decimal)))
    return {};
  return sign * decimal_value(text);
}

}  // namespace

Place Document::place(std::size_t at) const {
  Place place{1, 1};
  for (std::size_t i = 0; i < std::min(at, text.size()); ++i) {
    const bool ends_line = text[i] == '\n' || (text[i] == '\r' && text.substr(i + 1, 1) != "\n");
    if (ends_line)
      place = {place.line + 1, 1};
    else if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80)  // the first byte of a character
      ++place.column;
  }
  return place;
}

void Document::fail(std::size_t at, const std::string& problem) const {
  throw FileError(file, place(at), "", problem);
}

Document open_document(std::string text, const std::string& file, std::size_t most) {
  Document document{file, std::move(text)};
  if (document.text.compare(0, 3, "\xEF\xBB\xBF") == 0) document.text.erase(0, 3);
  if (document.text.size() > most)
    throw FileError(file, {}, "",
                    "is larger than " + std::to_string(most) + " bytes, the most that is read");
  for (std::size_t i = 0; i < document.text.size();) {
    const std::size_t size = character_size(document.text, i);
    if (size == 0) document.fail(i, "is not UTF-8 text");
    if (is_control(document.text, i) && !any_of(document.text.substr(i, 1), {"\t", "\n", "\r"}))
      document.fail(i, "is a control character, must be text");
    i += size;
  }
  return document;
}

Value plain_scalar(std::string_view text, std::size_t at) {
  if (any_of(text, {"", "~", "null", "Null", "NULL"})) return {{}, at};
  if (any_of(text, {"true", "True", "TRUE"})) return {true, at};
  if (any_of(text, {"false", "False", "FALSE"})) return {false, at};
  if (const auto value = number(text)) return {*value, at};
  return {std::string(text), at};
}

}  // namespace poise
