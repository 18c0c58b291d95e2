// Numbers in messages.
#pragma once

#include <locale>
#include <sstream>
#include <string>

namespace poise {

/// A number as people write it, whatever the locale.
inline std::string number_text(double value, int digits = 12) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(digits);
  out << value;
  return out.str();
}

}  // namespace poise
