#include "view.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "plot.hpp"

namespace poise {
namespace {

namespace fs = std::filesystem;

/// Where the page has room for the grasp, or for the mesh.
std::string place(const std::string& id, const std::string& json) {
  return "<script type=\"application/json\" id=\"" + id + "\">" + json + "</script>";
}

/// The page as it is built: installed beside the program, or beside its build folder.
std::string empty_page() {
  std::error_code none;
  const fs::path folder = fs::read_symlink("/proc/self/exe", none).parent_path();
  const fs::path installed = folder.parent_path() / "share/poise/playground.html";
  const fs::path built = folder.parent_path() / "web/dist/playground.html";
  for (const fs::path& path : {installed, built})
    if (std::ifstream in(path, std::ios::binary); in) {
      std::ostringstream text;
      text << in.rdbuf();
      return text.str();
    }
  throw OutputError("the page is neither installed (" + installed.string() + ") nor built (" +
                    built.string() + "): build it with ./dev web");
}

/// The grasp as JSON that cannot end the script element it stands in, whatever its names are.
std::string within_page(const std::string& grasp) {
  std::string text;
  for (const char c : grasp) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text;
}

}  // namespace

std::string view(const std::string& grasp, const std::string& page, const std::string& mesh) {
  std::string text = empty_page();
  for (const auto& [id, json] : {std::pair("grasp", &grasp), {"mesh", &mesh}}) {
    if (*json == "null") continue;
    const std::string empty = place(id, "null");
    const std::size_t at = text.find(empty);
    if (at == std::string::npos)
      throw OutputError(std::string("the page has no place for a ") + id);
    text.replace(at, empty.size(), place(id, within_page(*json)));
  }
  write_file(text, page);
  return "Wrote " + page + ": open it in a browser.\n";
}

}  // namespace poise
