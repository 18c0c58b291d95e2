// Tables of candidates: any text is rows, or a FileError.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "files/csv.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    poise::CsvReader reader(text, "fuzz.csv");
    while (const auto row = reader.next()) {
      if (row->size() != reader.header().size()) std::abort();
      try {
        for (std::size_t k = 0; k < row->size(); ++k) reader.number(*row, k);
      } catch (const poise::FileError&) {
      }
    }
  } catch (const poise::FileError&) {
  }
  return 0;
}
