// poise motion: what the fingers need while the object moves.
#include "ask/motion.hpp"

#include "answer.hpp"
#include "files/output.hpp"
#include "files/text.hpp"
#include "pictures/pictures.hpp"
#include "tables/motion.hpp"

namespace poise {
namespace {

struct Moved {
  std::string file{}, trajectory{}, csv{}, picture{};
  bool json{false}, offset{false};
  Question question{};
};

Reply move(const Moved& moved, const SpatialFile& file, const Grasp<3>& grasp) {
  if (!moved.csv.empty()) target_of(moved.csv);
  if (!moved.picture.empty()) target_of(moved.picture);
  warn(file.warnings);
  if (grasp.loads().size() > 1 || grasp.loads().front().size(1) != file.loads.front().weight)
    warn(
        {file_name(moved.file) +
         ": loads: a motion is of the first one's weight alone, not of its other parts or others"});
  const TrajectoryFile read = read_trajectory(moved.trajectory);
  warn(read.warnings);
  const std::vector<MotionState> states = motion_through(read.trajectory);
  warn(doubts(read, states, moved.trajectory));
  const Body body = body_of(file, file_name(moved.file), states);
  MotionReport report =
      move(grasp, body, read.trajectory,
           {moved.question.objective.value_or(file.objective), moved.question.force_cap});
  if (moved.offset)
    report.offset = best_offset(grasp, body, report.states,
                                {report.settings.objective, report.settings.force_cap});
  if (!moved.csv.empty()) write_file(csv_of(report), moved.csv);
  if (!moved.picture.empty()) draw_motion(file.name, grasp, report, moved.picture);
  std::string text = moved.json ? document(grasp, report)
                                : poise::report(file.name, grasp, body, report, style_of_output());
  if (!moved.json && !moved.picture.empty()) text += "\nDrawn in " + moved.picture + "\n";
  const MotionNeed& last = report.motion.needs[report.motion.slip.value_or(0)];
  return {text, !report.motion.slip, last.proven};
}

Reply move(const Moved& moved) {
  return with_grasp(moved.file, [&]<class File>(const File& file, const auto& grasp) -> Reply {
    if constexpr (std::is_same_v<File, PlanarFile>)
      throw UsageError("motion: " + moved.file +
                       " is in the plane (dimension 2), must be in space (dimension 3)");
    else
      return move(moved, file, grasp);
  });
}

}  // namespace

const Subcommand motion_command{
    "motion", "What the fingers need while the object moves, and how fast it may",
    [](Flags& flags) -> Run {
      const auto moved = std::make_shared<Moved>();
      flags.grasp_file(moved->file);
      flags.argument("TRAJECTORY",
                     "A table of poses, object to world: t, x, y, z, qw, qx, qy, qz (CSV)",
                     moved->trajectory, "files csv");
      flags.json(moved->json);
      flags.file("-o,--out", "CSV", "Write what is needed at each pose", moved->csv);
      flags.file("--plot", "SVG", "Draw what is needed over time", moved->picture);
      flags.flag("--offset", "Seek the constant turn in the wrist with which it needs least",
                 moved->offset);
      flags.objective(moved->question);
      flags.force_cap(moved->question);
      return [moved] { return move(*moved); };
    }};

}  // namespace poise
