// Words of a text between spaces, and numbers among them.
#pragma once

#include <charconv>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "meshes/formats.hpp"

namespace poise {

/// Lines end with LF, CR LF or CR.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  /// The next word of this line; empty at its end.
  std::string_view in_line() {
    skip(" \t\v\f");
    return word();
  }
  /// The next word of the text; empty at its end.
  std::string_view anywhere() {
    for (;;) {
      skip(" \t\v\f");
      if (at_ == text_.size() || !ends_line(text_[at_])) return word();
      next_line();
    }
  }
  /// Steps over the rest of the line; false where there is no other.
  bool next_line() {
    while (at_ < text_.size() && !ends_line(text_[at_])) ++at_;
    if (at_ == text_.size()) return false;
    if (text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n') ++at_;
    ++at_;
    ++line_;
    return at_ < text_.size();
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw ReadError("cannot be read: line " + std::to_string(line_) + " " + problem);
  }

 private:
  static bool ends_line(char c) { return c == '\n' || c == '\r'; }
  void skip(std::string_view spaces) {
    while (at_ < text_.size() && spaces.find(text_[at_]) != std::string_view::npos) ++at_;
  }
  std::string_view word() {
    const std::size_t from = at_;
    while (at_ < text_.size() &&
           std::string_view(" \t\v\f\r\n").find(text_[at_]) == std::string_view::npos)
      ++at_;
    return text_.substr(from, at_ - from);
  }

  std::string_view text_;
  std::size_t at_{0}, line_{1};
};

/// The number that a word is, also where it is too large or too small for one, or "nan".
inline std::optional<double> number_of(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  double value = 0;
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, value);
  if (word.empty() || rest != end) return {};
  if (error == std::errc::result_out_of_range)
    return word.find("e-") == std::string_view::npos && word.find("E-") == std::string_view::npos
               ? std::numeric_limits<double>::infinity()
               : 0;
  if (error != std::errc()) return {};
  return value;
}

/// The whole number that a word is.
inline std::optional<long long> whole_of(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  long long value = 0;
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, value);
  if (word.empty() || rest != end || error != std::errc()) return {};
  return value;
}

/// Whether two words are the same, but for capital letters in the first.
inline bool same_word(std::string_view word, std::string_view lower) {
  if (word.size() != lower.size()) return false;
  for (std::size_t k = 0; k < word.size(); ++k)
    if ((word[k] >= 'A' && word[k] <= 'Z' ? word[k] - 'A' + 'a' : word[k]) != lower[k])
      return false;
  return true;
}

}  // namespace poise
