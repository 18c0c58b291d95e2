#include "files/text.hpp"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iostream>
#include <system_error>

#include "files/value.hpp"
#include "readers/input.hpp"

namespace poise {
namespace {

std::string read_all(std::istream& in, const std::string& name, std::size_t most) {
  std::string text;
  for (std::size_t step = 1U << 16U; in && text.size() <= most; step *= 2) {
    const std::size_t size = text.size();
    text.resize(std::min(size + step, most + 1));
    in.read(text.data() + size, static_cast<std::streamsize>(text.size() - size));
    if (in.bad()) throw FileError(name, {}, "", "cannot be read");
    text.resize(size + static_cast<std::size_t>(in.gcount()));
  }
  return text;
}

}  // namespace

std::string file_name(const std::string& file) { return file == "-" ? "standard input" : file; }

std::string read_text(const std::string& file, std::size_t most) {
  if (file == "-") {
    note_input(file);
    return read_all(std::cin, file_name(file), most);
  }
  try {
    check_input(file);
  } catch (const ReadError& error) {
    throw FileError(file, {}, "", error.what());
  }
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in)
    throw FileError(file, {}, "", "cannot be opened: " + std::generic_category().message(errno));
  return read_all(in, file, most);
}

}  // namespace poise
