#include "tables/table.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string_view>

#include "files/degrees.hpp"
#include "files/text.hpp"

namespace poise {

Style style_of_output() {
  const auto variable = [](const char* name) {
    const char* const value = std::getenv(name);
    return std::string_view(value ? value : "");
  };
  return {.colour =
              isatty(STDOUT_FILENO) && variable("NO_COLOR").empty() && variable("TERM") != "dumb"};
}

std::string Style::bold(const std::string& text) const {
  return colour ? "\033[1m" + text + "\033[0m" : text;
}

std::string Style::dim(const std::string& text) const {
  return colour ? "\033[2m" + text + "\033[0m" : text;
}

std::size_t width(const std::string& text) {
  std::size_t characters = 0;
  for (std::size_t at = 0; at < text.size(); ++characters)
    at += std::max<std::size_t>(character_size(text, at), 1);
  return characters;
}

std::string wrapped(const std::string& words) {
  std::istringstream in(words);
  std::string text, line, word;
  while (in >> word) {
    if (!line.empty() && width(line) + 1 + width(word) > 90) {
      text += line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return text + line + "\n";
}

std::string fixed(double value, int decimals) {
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  return text.find_first_of("123456789") == std::string::npos && text.front() == '-'
             ? text.substr(1)
             : text;
}

int decimals_for(double largest) {
  if (!(largest > 0)) return 0;
  const double rounded = largest * 1.00005;  // 9.9999 to four digits is 10.00
  return std::clamp(3 - static_cast<int>(std::floor(std::log10(rounded))), 0, 15);
}

std::string plain(double value) {
  const double size = std::abs(value);
  return size >= 1e15 || (size > 0 && size < 1e-9) ? fmt::format("{:.3e}", value)
                                                   : fixed(value, decimals_for(size));
}

std::string degrees_text(double radians) { return fixed(degrees(radians), 2) + "°"; }

std::string newtons(double force) { return plain(force) + " N"; }

Table::Table(std::vector<std::string> headings) {
  for (std::string& heading : headings) {
    left_.push_back(heading.starts_with('<'));
    if (left_.back()) heading.erase(0, 1);
  }
  rows_.push_back(std::move(headings));
}

void Table::add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }

std::string Table::text(const Style& style) const {
  std::vector<std::size_t> widths(left_.size());
  for (const auto& row : rows_)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], width(row[k]));
  std::string text;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    if (r == 0 && std::all_of(rows_[0].begin(), rows_[0].end(),
                              [](const auto& cell) { return cell.empty(); }))
      continue;
    std::string line;
    for (std::size_t k = 0; k < rows_[r].size(); ++k) {
      const std::string& cell = rows_[r][k];
      const std::string space(widths[k] - width(cell), ' ');
      line += "  " + (left_[k] ? cell + space : space + cell);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += (r == 0 ? style.dim(line) : line) + "\n";
  }
  return text;
}

}  // namespace poise
