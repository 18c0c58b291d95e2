// A vector whose first N elements need no heap: holding with up to N contacts allocates nothing.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace poise {

/// As many plain elements as asked for; they start unset.
template <class T, std::size_t N>
class SmallVector {
  static_assert(std::is_trivially_destructible_v<T>);

 public:
  SmallVector() : size_(0) {}
  /// So many elements, unset.
  explicit SmallVector(std::size_t size) { resize(size); }
  SmallVector(const SmallVector& other) : size_(other.size_), large_(other.large_) { copy(other); }
  SmallVector(SmallVector&& other) noexcept : size_(other.size_), large_(std::move(other.large_)) {
    copy(other);
  }
  SmallVector& operator=(const SmallVector& other) {
    size_ = other.size_;
    large_ = other.large_;
    copy(other);
    return *this;
  }
  SmallVector& operator=(SmallVector&& other) noexcept {
    size_ = other.size_;
    large_ = std::move(other.large_);
    copy(other);
    return *this;
  }
  ~SmallVector() = default;

  /// The elements start unset again.
  void resize(std::size_t size) {
    size_ = size;
    if (size > N) large_.resize(size);
  }
  /// How many elements there are.
  std::size_t size() const { return size_; }
  /// Whether there are none.
  bool empty() const { return size_ == 0; }
  /// The first element; the others follow it.
  T* data() { return size_ > N ? large_.data() : small_.data(); }
  const T* data() const { return size_ > N ? large_.data() : small_.data(); }
  /// The first element.
  T* begin() { return data(); }
  const T* begin() const { return data(); }
  /// Behind the last element.
  T* end() { return data() + size_; }
  const T* end() const { return data() + size_; }
  /// An element, from 0; not checked.
  T& operator[](std::size_t i) { return data()[i]; }
  const T& operator[](std::size_t i) const { return data()[i]; }

 private:
  void copy(const SmallVector& other) {
    if (size_ <= N) std::copy_n(other.small_.begin(), size_, small_.begin());
  }

  std::size_t size_;
  std::array<T, N> small_;
  std::vector<T> large_;
};

}  // namespace poise
