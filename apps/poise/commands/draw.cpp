// poise draw: a picture of the object as it hangs.
#include "answer.hpp"
#include "files/output.hpp"
#include "pictures/pictures.hpp"
#include "readers/input.hpp"
#include "tables/parts.hpp"

namespace poise {
namespace {

struct Drawing {
  std::string file{}, out{};
  Question question{};
};

std::string posture_words(const Vector<2>& up) { return "at " + posture_text(up); }
std::string posture_words(const Vector<3>& up) { return "with " + posture_text(up) + " up"; }

/// What the picture shows, in a line.
template <int Dim>
std::string caption(const Grasp<Dim>& grasp, const NamedPosture<Dim>& shown) {
  const Posture<Dim>& posture = shown.posture;
  return (shown.name == "now"    ? "as it is held now, "
          : shown.name == "best" ? "best posture, "
                                 : "") +
         posture_words(posture.up) + ": " +
         (posture.holdable() ? least_text(grasp, posture) + ", " + to_string(posture.manner)
                             : "cannot be held") +
         load_text(grasp, posture.decides);
}

Reply draw(const Drawing& drawing) {
  if (!has_ending(drawing.out, ".svg") && !has_ending(drawing.out, ".png"))
    throw UsageError("--out: " + in_quotes(drawing.out) + " must end with .svg or .png");
  return with_grasp(drawing.file, [&](const auto& file, const auto& grasp) {
    target_of(drawing.out);
    warn(file.warnings);
    const auto shown = posture_to_show(file, grasp, drawing.question);
    draw_posture(file, grasp, shown.posture, caption(grasp, shown), drawing.out);
    return Reply{"Drawn in " + drawing.out + "\n", shown.posture.holdable(),
                 shown.posture.hold().proven};
  });
}

}  // namespace

const Subcommand draw_command{
    "draw", "A picture of the object as it hangs", [](Flags& flags) -> Run {
      const auto drawing = std::make_shared<Drawing>();
      flags.grasp_file(drawing->file);
      flags.file("-o,--out", "SVG|PNG", "The picture to write", drawing->out).required();
      flags.posture(drawing->question);
      flags.force_cap(drawing->question);
      return [drawing] { return draw(*drawing); };
    }};

}  // namespace poise
