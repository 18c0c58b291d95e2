#include "files/field.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "files/text.hpp"
#include "shape/number_text.hpp"

namespace poise {
namespace {

std::string described(const Value& value) {
  struct {
    std::string operator()(std::monostate) const { return "empty"; }
    std::string operator()(bool b) const { return b ? "true" : "false"; }
    std::string operator()(double d) const { return number_text(d); }
    std::string operator()(const std::string& s) const { return '"' + shown(s) + '"'; }
    std::string operator()(const List& l) const {
      return l.empty() ? "an empty list" : "a list of " + std::to_string(l.size());
    }
    std::string operator()(const Mapping&) const { return "a mapping"; }
  } const describe;
  return std::visit(describe, value.data);
}

/// Letters to insert, remove or change until one word is the other (Levenshtein).
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

std::string joined(const std::vector<std::string_view>& words, std::string_view last) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text.append(i == 0 ? "" : i + 1 == words.size() ? last : ", ").append(words[i]);
  return text;
}

}  // namespace

void Field::fail_at(std::size_t at, const std::string& path, const std::string& problem) const {
  throw FileError(document_->file, document_->place(at), path, problem);
}

void Field::fail(const std::string& problem) const { fail_at(at_, path_, problem); }

void Field::must_be(const std::string& expected) const {
  fail("is " + described(*value_) + ", must be " + expected);
}

double Field::number() const {
  const double number = finite();
  if (!std::isfinite(number * number)) must_be("within 1.3e154, or its square overflows");
  return number;
}

double Field::above_zero() const {
  const double value = number();
  if (!(value > 0)) fail("is " + number_text(value) + ", must be above 0");
  return value;
}

double Field::at_least_zero() const {
  const double value = number();
  if (!(value >= 0)) fail("is " + number_text(value) + ", must be at least 0");
  return value;
}

double Field::finite() const {
  const auto* number = std::get_if<double>(&value_->data);
  if (!number) must_be("a number");
  if (!std::isfinite(*number)) must_be("a finite number");
  return *number;
}

bool Field::truth() const {
  const auto* truth = std::get_if<bool>(&value_->data);
  if (!truth) must_be("true or false");
  return *truth;
}

bool Field::is_null() const { return std::holds_alternative<std::monostate>(value_->data); }

bool Field::is_list() const { return std::holds_alternative<List>(value_->data); }

bool Field::is_text() const { return std::holds_alternative<std::string>(value_->data); }

const std::string& Field::text() const {
  const auto* text = std::get_if<std::string>(&value_->data);
  if (!text &&
      (std::holds_alternative<double>(value_->data) || std::holds_alternative<bool>(value_->data)))
    must_be("text: put it in quotes");
  if (!text || text->empty()) must_be("text");
  for (std::size_t i = 0; i < text->size(); ++i)
    if (is_control(*text, i)) must_be("one line of text without control characters");
  return *text;
}

const std::string& Field::word(const std::vector<std::string_view>& words) const {
  const auto* text = std::get_if<std::string>(&value_->data);
  if (!text || std::find(words.begin(), words.end(), *text) == words.end())
    must_be(joined(words, " or "));
  return *text;
}

std::vector<Field> Field::list(const std::string& expected) const {
  const auto* parts = std::get_if<List>(&value_->data);
  if (!parts) must_be(expected);
  std::vector<Field> fields;
  fields.reserve(parts->size());
  for (std::size_t i = 0; i < parts->size(); ++i) fields.push_back(part((*parts)[i], i));
  return fields;
}

const Mapping& Field::mapping(const Keys& known, const Keys& elsewhere,
                              const std::string& why) const {
  const auto* members = std::get_if<Mapping>(&value_->data);
  if (!members) must_be("a mapping (keys: " + joined(known, ", ") + ")");
  Keys keys(known);
  keys.insert(keys.end(), elsewhere.begin(), elsewhere.end());
  std::vector<const Member*> seen(keys.size());
  for (const Member& member : *members) {
    const auto key = std::find(keys.begin(), keys.end(), member.key);
    const auto k = static_cast<std::size_t>(key - keys.begin());
    if (keys.empty()) fail_at(member.at, path_of(shown(member.key)), "is not a known key");
    if (key == keys.end()) {
      const std::string_view start = std::string_view(member.key).substr(0, 100);
      const auto nearest = std::min_element(keys.begin(), keys.end(), [&](auto a, auto b) {
        return distance(start, a) < distance(start, b);
      });
      fail_at(member.at, path_of(shown(member.key)),
              "is not a known key, the nearest is " + std::string(*nearest));
    }
    if (k >= known.size()) fail_at(member.at, path_of(member.key), why);
    if (seen[k])
      fail_at(
          member.at, path_of(member.key),
          "is given twice, first in line " + std::to_string(document_->place(seen[k]->at).line));
    seen[k] = &member;
  }
  return *members;
}

std::optional<Field> Field::find(std::string_view key) const {
  if (const auto* members = std::get_if<Mapping>(&value_->data))
    for (const Member& member : *members)
      if (member.key == key) return part(member);
  return {};
}

Field Field::get(std::string_view key, std::string_view expected) const {
  if (!std::holds_alternative<Mapping>(value_->data)) must_be("a mapping");
  if (auto field = find(key)) return *field;
  fail_at(at_, path_of(key), "is missing, must be " + std::string(expected));
}

Field Field::follow(const std::string& path) const {
  Field field = *this;
  for (std::size_t i = 0; i < path.size();) {
    std::optional<Field> next;
    if (path[i] == '[') {
      const std::size_t end = path.find(']', i);
      const auto* parts = std::get_if<List>(&field.value_->data);
      const std::size_t index = std::stoul(path.substr(i + 1, end - i - 1));
      if (parts && index < parts->size()) next = field.part((*parts)[index], index);
      i = end + 1;
    } else {
      if (path[i] == '.') ++i;
      const std::size_t end = std::min(path.find_first_of(".[", i), path.size());
      next = field.find(path.substr(i, end - i));
      i = end;
    }
    if (!next) break;
    field = *next;
  }
  return field;
}

Field Field::part(const Value& value, std::size_t index) const {
  return {*document_, value, path_ + "[" + std::to_string(index) + "]", value.at};
}

Field Field::part(const Member& member) const {
  return {*document_, member.value, path_of(member.key), member.value.at};
}

std::string Field::path_of(std::string_view key) const {
  return (path_.empty() ? "" : path_ + ".") + std::string(key);
}

}  // namespace poise
