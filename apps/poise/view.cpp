#include "view.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "plot.hpp"

namespace poise {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view before = "<script type=\"application/json\" id=\"grasp\">";
constexpr std::string_view empty = "null</script>";

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

std::string view(const std::string& grasp, const std::string& page) {
  std::string text = empty_page();
  const std::size_t at = text.find(std::string(before) + std::string(empty));
  if (at == std::string::npos) throw OutputError("the page has no place for a grasp");
  text.replace(at + before.size(), std::string_view("null").size(), within_page(grasp));
  write_file(text, page);
  return "Wrote " + page + ": open it in a browser.\n";
}

}  // namespace poise
