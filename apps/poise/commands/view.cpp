// poise view: the page on which a grasp can be taken hold of (web/).
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "answer.hpp"
#include "files/grasp_writer.hpp"
#include "files/output.hpp"
#include "pictures/plot.hpp"

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

/// Writes the page with a grasp (a grasp file in JSON) inside, and with a mesh to draw (its points
/// and triangles in JSON, or null), and says so.
std::string view(const std::string& grasp, const std::string& page,
                 const std::string& mesh = "null") {
  target_of(page);
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

std::string view(const PlanarFile& file, const std::string& page) {
  return view(grasp_document(file), page);
}

/// The page reads no other files: it gets the contacts written out, and the mesh to draw.
std::string view(SpatialFile file, const std::string& page) {
  const auto* const shape = file.shape ? std::get_if<MeshShape>(&*file.shape) : nullptr;
  if (shape == nullptr) return view(grasp_document(file), page);
  const std::string mesh = mesh_document(*shape->mesh);
  file.shape.reset();
  return view(grasp_document(file), page, mesh);
}

/// Where it is written to unless told: in the present folder.
std::string page_of(const std::string& file) {
  return (file == "-" ? "grasp" : fs::path(file).stem().string()) + ".html";
}

}  // namespace

const Subcommand view_command{
    "view", "Write a page on which to turn and change the grasp", [](Flags& flags) -> Run {
      const auto file = std::make_shared<std::string>(), page = std::make_shared<std::string>();
      flags.grasp_file(*file);
      flags.file("-o,--out", "HTML", "The page to write (the name of FILE, with .html)", *page);
      return [file, page] {
        return std::visit(
            [&](const auto& read) {
              warn(read.warnings);
              return Reply{view(read, page->empty() ? page_of(*file) : *page)};
            },
            read_grasp_file(*file));
      };
    }};

}  // namespace poise
