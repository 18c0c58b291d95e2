// Reading typed fields from a document; whatever is wrong is told with its path and place.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/value.hpp"
#include "poise/wrench.hpp"

namespace poise {

/// How a point or direction is written.
template <int Dim>
inline constexpr const char* coordinates = Dim == 2 ? "[x, y]" : "[x, y, z]";

using Keys = std::vector<std::string_view>;

/// A value within a document, which must outlive it. All its functions throw FileError.
class Field {
 public:
  explicit Field(const Document& document) : Field(document, document.root, "", document.root.at) {}

  [[noreturn]] void fail(const std::string& problem) const;

  /// The number: finite, and its square too.
  double number() const;
  /// The same, above 0, or at least 0.
  double above_zero() const;
  double at_least_zero() const;
  /// The number: finite.
  double finite() const;
  bool truth() const;
  bool is_null() const;
  bool is_text() const;
  bool is_list() const;
  /// A line of text, not empty.
  const std::string& text() const;
  /// One of these words.
  const std::string& word(const std::vector<std::string_view>& words) const;
  template <int Dim>
  Vector<Dim> vector() const;
  std::vector<Field> list(const std::string& expected = "a list") const;

  /// A mapping all of whose keys are `known` and come once. Those of `elsewhere` are known too, but
  /// out of place here; `why` says so.
  const Mapping& mapping(const Keys& known, const Keys& elsewhere = {},
                         const std::string& why = "") const;
  /// The value of a key of a mapping, if it is there.
  std::optional<Field> find(std::string_view key) const;
  /// The value of a key that must be there.
  Field get(std::string_view key, std::string_view expected) const;

  /// The value at a path such as "contacts[1].friction", or as much of the path as there is.
  Field follow(const std::string& path) const;

  const std::string& path() const { return path_; }
  Place place() const { return document_->place(at_); }
  const std::string& file() const { return document_->file; }

 private:
  Field(const Document& document, const Value& value, std::string path, std::size_t at)
      : document_(&document), value_(&value), path_(std::move(path)), at_(at) {}

  Field part(const Value& value, std::size_t index) const;
  Field part(const Member& member) const;
  std::string path_of(std::string_view key) const;
  [[noreturn]] void fail_at(std::size_t at, const std::string& path,
                            const std::string& problem) const;
  [[noreturn]] void must_be(const std::string& expected) const;
  void check_list(std::size_t size, const std::string& expected) const;

  const Document* document_;
  const Value* value_;
  std::string path_;
  std::size_t at_;
};

template <int Dim>
Vector<Dim> Field::vector() const {
  const auto* parts = std::get_if<List>(&value_->data);
  if (!parts || parts->size() != Dim) must_be(coordinates<Dim>);
  Vector<Dim> result;
  for (std::size_t k = 0; k < Dim; ++k)
    result[static_cast<Eigen::Index>(k)] = part((*parts)[k], k).number();
  if (!std::isfinite(result.squaredNorm())) fail("is too long, its square overflows");
  return result;
}

}  // namespace poise
