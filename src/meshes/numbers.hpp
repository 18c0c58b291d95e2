// Numbers as files have them in bytes.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace poise {

enum class NumberType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

constexpr std::size_t size_of(NumberType type) {
  switch (type) {
    case NumberType::int8:
    case NumberType::uint8:
      return 1;
    case NumberType::int16:
    case NumberType::uint16:
      return 2;
    case NumberType::float64:
      return 8;
    default:
      return 4;
  }
}

constexpr bool is_whole(NumberType type) {
  return type != NumberType::float32 && type != NumberType::float64;
}

/// The number in the first bytes, of which there are enough.
inline double number_at(const char* bytes, NumberType type,
                        std::endian order = std::endian::little) {
  std::array<char, 8> own{};
  const std::size_t size = size_of(type);
  std::copy(bytes, bytes + size, own.begin());
  if (order != std::endian::native)
    std::reverse(own.begin(), own.begin() + static_cast<std::ptrdiff_t>(size));
  const auto as = [&]<class Number>(Number number) {
    std::memcpy(&number, own.data(), sizeof number);
    return static_cast<double>(number);
  };
  switch (type) {
    case NumberType::int8:
      return as(std::int8_t{});
    case NumberType::uint8:
      return as(std::uint8_t{});
    case NumberType::int16:
      return as(std::int16_t{});
    case NumberType::uint16:
      return as(std::uint16_t{});
    case NumberType::int32:
      return as(std::int32_t{});
    case NumberType::uint32:
      return as(std::uint32_t{});
    case NumberType::float32:
      return as(float{});
    default:
      return as(double{});
  }
}

}  // namespace poise
