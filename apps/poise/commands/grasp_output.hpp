// A grasp file, printed or written.
#pragma once

#include <filesystem>
#include <string>

#include "commands.hpp"
#include "files/grasp_writer.hpp"
#include "files/output.hpp"

namespace poise {

/// What is printed is taken to go to the present folder.
template <class File>
Reply printed_or_written(const File& file, WriteAs as, const std::string& out) {
  std::string text;
  if constexpr (std::is_same_v<File, PlanarFile>)
    text = grasp_document(file);
  else
    text = grasp_document(
        file, as, out.empty() ? "." : std::filesystem::absolute(out).parent_path().string());
  if (out.empty()) return {text};
  write_file(text, out);
  return {"Wrote " + out + "\n"};
}

}  // namespace poise
