#include "files/text.hpp"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <system_error>

#include "files/value.hpp"

namespace poise {
namespace {

std::string read_all(std::istream& in, const std::string& name, std::size_t most) {
  std::string text(most + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) throw FileError(name, {}, "", "cannot be read");
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

}  // namespace

std::size_t character_size(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t k) -> unsigned {
    return at + k < text.size() ? static_cast<unsigned char>(text[at + k]) : 0;
  };
  const auto tail = [&](std::size_t k, unsigned low = 0x80, unsigned high = 0xBF) {
    return byte(k) >= low && byte(k) <= high;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return tail(1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    // Neither overlong nor half a surrogate pair.
    const bool second = tail(1, first == 0xE0 ? 0xA0 : 0x80, first == 0xED ? 0x9F : 0xBF);
    return second && tail(2) ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    const bool second = tail(1, first == 0xF0 ? 0x90 : 0x80, first == 0xF4 ? 0x8F : 0xBF);
    return second && tail(2) && tail(3) ? 4 : 0;
  }
  return 0;
}

bool is_control(std::string_view text, std::size_t at) {
  const auto first = static_cast<unsigned char>(text[at]);
  if (first < 0x20 || first == 0x7F) return true;
  return first == 0xC2 && at + 1 < text.size() && static_cast<unsigned char>(text[at + 1]) < 0xA0;
}

std::string shown(std::string_view text) {
  constexpr int longest = 40;
  std::string result;
  std::size_t at = 0;
  for (int characters = 0; at < text.size() && characters < longest; ++characters) {
    const std::size_t size = character_size(text, at);
    if (size == 0 || is_control(text, at))
      result += '?';
    else
      result += text.substr(at, size);
    at += size == 0 ? 1 : size;
  }
  return at < text.size() ? result + "..." : result;
}

std::string file_name(const std::string& file) { return file == "-" ? "standard input" : file; }

std::string read_text(const std::string& file, std::size_t most) {
  if (file == "-") return read_all(std::cin, file_name(file), most);
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw FileError(file, {}, "", "is a directory, must be a file");
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in)
    throw FileError(file, {}, "", "cannot be opened: " + std::generic_category().message(errno));
  return read_all(in, file, most);
}

}  // namespace poise
