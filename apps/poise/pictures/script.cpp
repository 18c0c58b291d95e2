#include "pictures/script.hpp"

#include <algorithm>

#include "files/text.hpp"

namespace poise {

std::string quoted(const std::string& text, std::size_t longest) {
  std::string result = "'";
  std::size_t at = 0;
  for (std::size_t k = 0; at < text.size() && k < longest; ++k) {
    const std::size_t size = std::max<std::size_t>(character_size(text, at), 1);
    result += is_control(text, at)  ? " "
              : is_unseen(text, at) ? "?"
              : text[at] == '\''    ? "''"
                                    : text.substr(at, size);
    at += size;
  }
  return result + (at < text.size() ? "…'" : "'");
}

namespace {

void begin_plots(Script& script, double letter) {
  script.line("set encoding utf8\nset multiplot");
  script.line("set key bmargin center horizontal Left reverse samplen 1.3 spacing 1.2 font ',{}'",
              letter);
  script.line("set style textbox opaque fc rgb '#aaffffff' noborder margins 0.1,0.1");
}

}  // namespace

void begin_picture(Script& script, double width, double height, bool enhanced) {
  script.line("set terminal svg size {},{} {} font 'sans-serif,15' background '#ffffff'", width,
              height, enhanced ? "enhanced" : "noenhanced");
  begin_plots(script, 13);
}

void begin_png(Script& script, double width, double height) {
  script.line(
      "set terminal pngcairo size {},{} noenhanced font 'sans-serif,11.25' background '#ffffff' "
      "fontscale 2 linewidth 2 pointscale 2",
      2 * width, 2 * height);
  begin_plots(script, 9.75);
}

}  // namespace poise
