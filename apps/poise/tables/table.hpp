// Numbers and tables for people.
#pragma once

#include <string>
#include <vector>

namespace poise {

/// Bold and dim where the reader is a terminal, nothing elsewhere.
struct Style {
  bool colour{false};
  std::string bold(const std::string& text) const;
  std::string dim(const std::string& text) const;
};
/// Colour on a terminal alone, and not where the user has asked for none: no-color.org.
Style style_of_output();

/// Columns a text takes on a terminal: its characters.
std::size_t width(const std::string& text);

/// Words in lines of at most 90 columns, each with a line end.
std::string wrapped(const std::string& words);

/// A number with so many decimals, never -0.
std::string fixed(double value, int decimals);
/// A vector like (1.00, 0.00).
template <class Vector>
std::string vector_text(const Vector& vector, int decimals) {
  std::string text;
  for (const double value : vector.eval())
    text += (text.empty() ? "(" : ", ") + fixed(value, decimals);
  return text + ")";
}
/// Decimals that show the largest of some numbers with four digits.
int decimals_for(double largest);
/// A number with at least four digits, without an exponent unless it is below 1e-9 or above 1e15.
std::string plain(double value);
/// An angle in degrees, like 30.00°.
std::string degrees_text(double radians);
/// A force norm, like 12.25 N.
std::string newtons(double force);

/// Rows of cells under a heading, columns aligned: a heading that begins with < is flush left.
/// Headings that are all empty are not shown.
class Table {
 public:
  explicit Table(std::vector<std::string> headings);
  void add(std::vector<std::string> row);
  std::string text(const Style& style) const;

 private:
  std::vector<bool> left_{};
  std::vector<std::vector<std::string>> rows_{};
};

}  // namespace poise
