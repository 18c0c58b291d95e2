// poise import: a grasp of a data set as a grasp file.
#include <cmath>

#include "answer.hpp"
#include "commands/grasp_output.hpp"
#include "data/acronym.hpp"

namespace poise {
namespace {

struct Import {
  std::string kind{}, file{}, mesh_root{}, out{};
  std::size_t grasp{0};
};

Reply import(const Import& wanted) {
  if (wanted.kind != "acronym")
    throw UsageError("import: " + in_quotes(wanted.kind) +
                     " is no known data set, must be acronym");
  const Acronym data(wanted.file, wanted.mesh_root);
  if (wanted.grasp >= data.size())
    throw UsageError("--grasp: is " + std::to_string(wanted.grasp) + ", " + wanted.file + " has " +
                     std::to_string(data.size()) + " grasps, the first is 0");
  try {
    const SpatialFile file = data.grasp(wanted.grasp);
    warn(file.warnings);
    return printed_or_written(file, WriteAs::gripper, wanted.out);
  } catch (const MissedGrip& missed) {
    throw FileError(wanted.file, {}, "grasp " + std::to_string(wanted.grasp), missed.what());
  }
}

}  // namespace

const Subcommand import_command{
    "import", "A grasp of a data set as a grasp file", [](Flags& flags) -> Run {
      const auto wanted = std::make_shared<Import>();
      flags.argument("KIND", "acronym, the only data set that is known", wanted->kind,
                     "words acronym");
      flags.argument("FILE", "The file of the data set (.h5)", wanted->file, "files h5");
      flags.folder("--mesh-root", "The folder that has the meshes/", wanted->mesh_root).required();
      flags
          .value("--grasp", "N", "Which grasp of the file, from 0",
                 [wanted](const std::string& text) {
                   wanted->grasp = static_cast<std::size_t>(read_number(
                       "--grasp", text, "the number of a grasp, the first is 0",
                       [](double n) { return n >= 0 && n <= 1e9 && n == std::floor(n); }));
                 })
          .required();
      flags.file("-o,--out", "FILE", "The grasp file to write, instead of printing it",
                 wanted->out);
      return [wanted] { return import(*wanted); };
    }};

}  // namespace poise
