// What YAML and JSON have in common: values, each with the place where it is written.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "files/file_error.hpp"

namespace poise {

struct Value;
struct Member;
using List = std::vector<Value>;
using Mapping = std::vector<Member>;  ///< in the order of the file; a key may come twice

struct Value {
  std::variant<std::monostate, bool, double, std::string, List, Mapping> data;
  std::size_t at{0};  ///< where it begins in the text [bytes]
};

struct Member {
  std::string key;
  std::size_t at{0};  ///< of the key
  Value value{};
};

/// A text, its name, and the value that it spells.
struct Document {
  std::string file, text;
  Value root{};

  Place place(std::size_t at) const;
  [[noreturn]] void fail(std::size_t at, const std::string& problem) const;
};

/// Limits that keep a hostile file from taking the stack, the memory or the day.
inline constexpr std::size_t max_text = std::size_t{1} << 20;    ///< of a grasp file [bytes]
inline constexpr std::size_t max_result = std::size_t{1} << 26;  ///< of a result [bytes]
inline constexpr std::size_t max_values = 1'000'000;             ///< aliases written out
inline constexpr int max_depth = 32;

/// A document yet without its value: the text without byte order mark, known to be UTF-8 without
/// control characters.
/// @throws FileError
Document open_document(std::string text, const std::string& file, std::size_t most = max_text);

/// The value of a plain (unquoted) scalar by the core schema of YAML 1.2.
Value plain_scalar(std::string_view text, std::size_t at);

/// @throws FileError
Document parse_json(std::string text, const std::string& file, std::size_t most = max_text);
/// YAML 1.2, and so JSON as well.
/// @throws FileError
Document parse_yaml(std::string text, const std::string& file);

}  // namespace poise
