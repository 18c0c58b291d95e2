// Gnuplot scripts, and what the pictures have in common.
#pragma once

#include <fmt/core.h>

#include <iterator>
#include <string>
#include <vector>

#include "poise/wrench.hpp"

namespace poise {

// Few colours, each with one meaning.
inline constexpr const char* force_colour = "#0b5394";
inline constexpr const char* cone_colour = "#b9d5ec";
inline constexpr const char* weight_colour = "#a61c00";
inline constexpr const char* limit_colour = "#e69138";
inline constexpr const char* object_colour = "#f1efe9";
inline constexpr const char* unholdable_colour = "#d4d4d4";
inline constexpr const char* fork_colour = "#e4f0db";
inline constexpr const char* line_colour = "#555555";
inline constexpr const char* best_colour = "#38761d";

/// A gnuplot script in the making.
class Script {
 public:
  template <class... Parts>
  void line(fmt::format_string<Parts...> format, Parts&&... parts) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Parts>(parts)...);
    text_ += '\n';
  }

  /// Names rows of numbers, or of groups of rows with an empty line between them.
  void data(const std::string& name, const std::vector<std::vector<Vector<2>>>& groups) {
    line("${} << end", name);
    for (const auto& group : groups) {
      for (const Vector<2>& point : group) line("{} {}", point.x(), point.y());
      line("");
    }
    line("end");
  }

  /// Adds a part of the next plot command.
  template <class... Parts>
  void layer(fmt::format_string<Parts...> format, Parts&&... parts) {
    layers_ += (layers_.empty() ? "plot " : ", \\\n  ") +
               fmt::format(format, std::forward<Parts>(parts)...);
  }
  void plot() {
    line("{}", layers_);
    layers_.clear();
  }

  const std::string& text() const { return text_; }

 private:
  std::string text_{}, layers_{};
};

/// A string of gnuplot that means just these characters, of which at most `longest` are kept.
std::string quoted(const std::string& text, std::size_t longest);

/// An SVG picture of several plots, in pixels; `enhanced` text may have exponents.
void begin_picture(Script& script, double width, double height, bool enhanced = false);
/// The same as a PNG, with two pixels for one.
void begin_png(Script& script, double width, double height);

}  // namespace poise
