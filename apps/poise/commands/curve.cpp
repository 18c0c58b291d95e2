// poise curve: the least effort or grip over all postures of the plane.
#include "answer.hpp"
#include "files/output.hpp"
#include "pictures/pictures.hpp"

namespace poise {
namespace {

/// The object in its best posture, beside the curve.
void plot(const PlanarFile& file, const Grasp<2>& grasp, Question question,
          const std::string& path) {
  question.command = Command::best;
  draw_curve(file, grasp, std::get<BestAnswer<2>>(ask(file, grasp, question).of), path);
}

/// There is no curve in space, and no answer either.
void plot(const SpatialFile&, const Grasp<3>&, const Question&, const std::string&) {}

Reply curve(const Asked& asked, const std::string& picture) {
  return with_grasp(asked.file, [&](const auto& file, const auto& grasp) {
    if (!picture.empty()) target_of(picture);
    Reply reply = answer(asked, file, grasp);
    if (picture.empty()) return reply;
    plot(file, grasp, asked.question, picture);
    if (!asked.json) reply.text += "\nDrawn in " + picture + "\n";
    return reply;
  });
}

}  // namespace

const Subcommand curve_command{
    "curve", "The least effort or grip over all postures, with its optima",
    [](Flags& flags) -> Run {
      const auto asked = declare_question(flags, Command::curve);
      const auto picture = std::make_shared<std::string>();
      flags.domain(asked->question);
      flags.objective(asked->question);
      flags.force_cap(asked->question);
      flags.file("--plot", "SVG", "Draw the held object beside the curve", *picture);
      return [asked, picture] { return curve(*asked, *picture); };
    }};

}  // namespace poise
