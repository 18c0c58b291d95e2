#include "files/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace poise {

CsvReader::CsvReader(std::string_view text, std::string file)
    : text_(text), file_(std::move(file)) {
  if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
  const auto first = cells();
  if (!first) throw FileError(file_, {}, "", "is empty, must begin with a header");
  for (const Cell& cell : *first) {
    if (std::find(header_.begin(), header_.end(), cell.text) != header_.end())
      throw FileError(file_, cell.place, "", "the column \"" + cell.text + "\" is there twice");
    header_.push_back(cell.text);
  }
}

std::optional<std::size_t> CsvReader::column(std::string_view name) const {
  const auto found = std::find(header_.begin(), header_.end(), name);
  if (found == header_.end()) return {};
  return static_cast<std::size_t>(found - header_.begin());
}

std::optional<std::vector<Cell>> CsvReader::next() {
  auto row = cells();
  if (!row) return {};
  ++row_;
  if (row->size() != header_.size())
    throw FileError(file_, row->front().place, "row " + std::to_string(row_),
                    "has " + std::to_string(row->size()) + " cells, must have " +
                        std::to_string(header_.size()) + " as the header has");
  return row;
}

void CsvReader::fail(const Cell& cell, std::size_t column, const std::string& problem) const {
  throw FileError(file_, cell.place, "row " + std::to_string(row_) + ", column " + header_[column],
                  problem);
}

double CsvReader::number(const std::vector<Cell>& row, std::size_t column) const {
  std::string_view text = row[column].text;
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || rest != text.data() + text.size() || !std::isfinite(value))
    fail(row[column], column,
         (row[column].text.empty() ? "is empty" : "is \"" + row[column].text + "\"") +
             ", must be a number");
  return value;
}

std::optional<std::vector<Cell>> CsvReader::cells() {
  // Empty lines.
  while (at_ < text_.size() && (text_[at_] == '\n' || text_[at_] == '\r')) {
    if (text_[at_++] == '\n') ++place_.line;
  }
  if (at_ >= text_.size()) return {};
  place_.column = 1;
  std::vector<Cell> row;
  for (;;) {
    row.push_back(cell());
    if (at_ >= text_.size()) return row;
    const char end = text_[at_++];
    ++place_.column;
    if (end == ',') continue;
    if (end == '\r' && at_ < text_.size() && text_[at_] == '\n') ++at_;
    ++place_.line;
    return row;
  }
}

/// Up to the comma or the line end after it, at which `at_` is then.
Cell CsvReader::cell() {
  Cell cell{{}, place_};
  const auto step = [&] {
    const char c = text_[at_++];
    if (c == '\n') {
      ++place_.line;
      place_.column = 1;
    } else if ((static_cast<unsigned char>(c) & 0xC0U) != 0x80U) {  // not inside of a character
      ++place_.column;
    }
    return c;
  };
  if (at_ < text_.size() && text_[at_] == '"') {
    step();
    for (;;) {
      if (at_ >= text_.size()) throw FileError(file_, cell.place, "", "a quote is never closed");
      const char c = step();
      if (c != '"') {
        cell.text += c;
      } else if (at_ < text_.size() && text_[at_] == '"') {
        cell.text += step();
      } else {
        break;
      }
    }
  }
  while (at_ < text_.size() && text_[at_] != ',' && text_[at_] != '\n' && text_[at_] != '\r')
    cell.text += step();
  return cell;
}

}  // namespace poise
