// Tables in files: comma-separated values with a header (RFC 4180).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/file_error.hpp"

namespace poise {

/// A cell of a row, without its quotes.
struct Cell {
  std::string text{};
  Place place{};
};

/// The rows of a text one after the other. Empty lines are passed over.
class CsvReader {
 public:
  /// Reads the header.
  /// @throws FileError where there is none, or a name stands in it twice
  CsvReader(std::string_view text, std::string file);

  const std::vector<std::string>& header() const { return header_; }
  /// The column of a name, where there is one.
  std::optional<std::size_t> column(std::string_view name) const;
  /// The cells of the next row, as many as the header has; none at the end.
  /// @throws FileError
  std::optional<std::vector<Cell>> next();

  /// @throws FileError that names the row, counted from 1, and the column
  [[noreturn]] void fail(const Cell& cell, std::size_t column, const std::string& problem) const;
  /// A finite number. @throws FileError
  double number(const std::vector<Cell>& row, std::size_t column) const;

 private:
  std::optional<std::vector<Cell>> cells();
  Cell cell();

  std::string_view text_;
  std::string file_;
  std::vector<std::string> header_{};
  std::size_t at_{0}, row_{0};
  Place place_{1, 1};
};

}  // namespace poise
