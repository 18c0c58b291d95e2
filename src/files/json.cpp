// JSON read by hand: nlohmann's parser does not tell where a value stands, yaml-cpp refuses
// \uD83D\uDE00.
#include <algorithm>

#include "files/value.hpp"

namespace poise {
namespace {

class Reader {
 public:
  explicit Reader(Document& document) : document_(document), text_(document.text) {}

  void read() {
    document_.root = value(0);
    skip_space();
    if (at_ < text_.size()) fail("the text must end after its value");
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const { document_.fail(at_, problem); }

  char next() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  void skip_space() { at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()); }

  /// Steps over `c` and the space before it, if it is there.
  bool take(char c) {
    skip_space();
    if (next() != c) return false;
    ++at_;
    return true;
  }

  void want(char c) {
    if (!take(c)) fail(std::string("'") + c + "' expected");
  }

  Value value(int depth) {
    skip_space();
    if (depth > max_depth) fail("is nested too deeply");
    if (next() == '"') {
      const std::size_t at = at_;
      return {text(), at};
    }
    if (next() == '[') return list(depth);
    if (next() == '{') return mapping(depth);
    const std::size_t end = std::min(text_.find_first_of(" \t\r\n,:[]{}\"", at_), text_.size());
    Value scalar = plain_scalar(text_.substr(at_, end - at_), at_);
    if (end == at_ || std::holds_alternative<std::string>(scalar.data)) fail("a value expected");
    at_ = end;
    return scalar;
  }

  Value list(int depth) {
    const std::size_t at = at_;
    List list;
    want('[');
    if (take(']')) return {list, at};
    do list.push_back(value(depth + 1));
    while (take(','));
    want(']');
    return {std::move(list), at};
  }

  Value mapping(int depth) {
    const std::size_t at = at_;
    Mapping mapping;
    want('{');
    if (take('}')) return {mapping, at};
    do {
      skip_space();
      const std::size_t key_at = at_;
      if (next() != '"') fail("a key in quotes expected");
      std::string key = text();
      want(':');
      mapping.push_back({std::move(key), key_at, value(depth + 1)});
    } while (take(','));
    want('}');
    return {std::move(mapping), at};
  }

  std::string text() {
    std::string result;
    for (++at_; next() != '"'; ++at_) {
      if (at_ >= text_.size()) fail("the text ends within quotes");
      if (next() == '\n' || next() == '\r') fail("the line ends within quotes");
      if (next() == '\\')
        escape(result);
      else
        result += next();
    }
    ++at_;
    return result;
  }

  /// From the backslash to the last character of the escape.
  void escape(std::string& result) {
    ++at_;
    constexpr std::string_view names = "\"\\/bfnrt", characters = "\"\\/\b\f\n\r\t";
    if (next() == 'u')
      append_utf8(result, code_point());
    else if (const auto k = names.find(next()); k != std::string_view::npos)
      result += characters[k];
    else
      fail("unknown escape");
  }

  /// From the u to the last digit; of a surrogate pair, of the second escape.
  unsigned code_point() {
    const unsigned high = hex4();
    if (high < 0xD800 || high > 0xDFFF) return high;
    if (high < 0xDC00 && text_.substr(at_ + 1, 2) == "\\u") {
      at_ += 2;
      if (const unsigned low = hex4(); low >= 0xDC00 && low <= 0xDFFF)
        return 0x10000 + ((high - 0xD800) << 10) + (low - 0xDC00);
    }
    fail("half a surrogate pair");
  }

  unsigned hex4() {
    unsigned code = 0;
    for (int k = 0; k < 4; ++k) {
      ++at_;
      const auto digit =
          std::string_view("0123456789abcdef").find(static_cast<char>(next() | 0x20));
      if (digit == std::string_view::npos) fail("four hexadecimal digits expected");
      code = code * 16 + static_cast<unsigned>(digit);
    }
    return code;
  }

  static void append_utf8(std::string& result, unsigned code) {
    const auto byte = [&](unsigned bits) { result += static_cast<char>(bits); };
    if (code < 0x80) {
      byte(code);
    } else if (code < 0x800) {
      byte(0xC0 | code >> 6);
      byte(0x80 | (code & 0x3F));
    } else if (code < 0x10000) {
      byte(0xE0 | code >> 12);
      byte(0x80 | (code >> 6 & 0x3F));
      byte(0x80 | (code & 0x3F));
    } else {
      byte(0xF0 | code >> 18);
      byte(0x80 | (code >> 12 & 0x3F));
      byte(0x80 | (code >> 6 & 0x3F));
      byte(0x80 | (code & 0x3F));
    }
  }

  Document& document_;
  std::string_view text_;
  std::size_t at_{0};
};

}  // namespace

Document parse_json(std::string text, const std::string& file, std::size_t most) {
  Document document = open_document(std::move(text), file, most);
  Reader(document).read();
  return document;
}

}  // namespace poise
