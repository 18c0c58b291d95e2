#include "shape/characters.hpp"

#include <algorithm>

namespace poise {

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

bool is_unseen(std::string_view text, std::size_t at) {
  const std::size_t size = character_size(text, at);
  if (size < 2) return false;
  unsigned code = static_cast<unsigned char>(text[at]) & (0xFFU >> (size + 1));
  for (std::size_t k = 1; k < size; ++k)
    code = code << 6 | (static_cast<unsigned char>(text[at + k]) & 0x3FU);
  constexpr std::pair<unsigned, unsigned> ranges[] = {
      {0xAD, 0xAD},     {0x61C, 0x61C},   {0x180E, 0x180E}, {0x200B, 0x200F}, {0x2028, 0x202E},
      {0x2060, 0x206F}, {0xFEFF, 0xFEFF}, {0xFFF9, 0xFFFB}, {0xFFFE, 0xFFFF}, {0xE0000, 0xE007F}};
  return std::any_of(std::begin(ranges), std::end(ranges), [&](const auto& range) {
    return code >= range.first && code <= range.second;
  });
}

std::string shown(std::string_view text) {
  constexpr int longest = 40;
  std::size_t at = 0;
  for (int characters = 0; at < text.size() && characters < longest; ++characters)
    at += std::max<std::size_t>(character_size(text, at), 1);
  return harmless(text.substr(0, at), "") + (at < text.size() ? "..." : "");
}

std::string harmless(std::string_view text, std::string_view kept) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t size = character_size(text, at);
    const bool is_kept = kept.find(text[at]) != std::string_view::npos;
    if (size == 0 || (is_control(text, at) && !is_kept) || is_unseen(text, at))
      result += '?';
    else
      result += text.substr(at, size);
    at += std::max<std::size_t>(size, 1);
  }
  return result;
}

}  // namespace poise
