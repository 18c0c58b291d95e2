#include "commands.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "files/result.hpp"
#include "paper.hpp"
#include "picture.hpp"
#include "plot.hpp"
#include "report.hpp"
#include "view.hpp"

namespace poise {
namespace {

/// Colour on a terminal alone, and not where the user has asked for none: no-color.org.
Style style_of_output() {
  const auto variable = [](const char* name) {
    const char* const value = std::getenv(name);
    return std::string_view(value ? value : "");
  };
  return {.colour =
              isatty(STDOUT_FILENO) && variable("NO_COLOR").empty() && variable("TERM") != "dumb"};
}

Answer answer_hold(const Arguments& arguments, const GraspFile& file, const Grasp<2>& grasp) {
  constexpr double degree = 3.14159265358979323846 / 180;
  const double theta = arguments.up          ? angle_of(*arguments.up)
                       : arguments.angle_deg ? *arguments.angle_deg * degree
                                             : file.angle.value_or(0);
  const HoldSettings settings{.force_cap = arguments.force_cap};
  const Hold<2> result = hold(grasp, up_at(theta), settings);
  return {arguments.json ? hold_document(grasp, theta, result, settings,
                                         {.angle_deg = arguments.angle_deg, .up = arguments.up})
                         : hold_report(file, grasp, theta, result, style_of_output()),
          result.holdable};
}

Answer answer_best(const Arguments& arguments, const GraspFile& file, const Grasp<2>& grasp,
                   const CurveSettings& settings) {
  const BestPosture best = best_posture(grasp, settings);
  return {arguments.json ? best_document(grasp, best, settings)
                         : best_report(file, grasp, best, settings, style_of_output()),
          best.holdable()};
}

Answer answer_curve(const Arguments& arguments, const GraspFile& file, const Grasp<2>& grasp,
                    const CurveSettings& settings) {
  const PostureCurve curve = posture_curve(grasp, settings);
  if (arguments.plot)
    draw(picture(file, grasp, best_posture(grasp, settings), settings), *arguments.plot);
  Answer answer{arguments.json ? curve_document(grasp, curve, settings)
                               : curve_report(file, grasp, curve, settings, style_of_output()),
                !curve.holdable.empty()};
  if (!arguments.json && arguments.plot) answer.text += "\nDrawn in " + *arguments.plot + "\n";
  return answer;
}

}  // namespace

Answer answer(const Arguments& arguments) {
  if (arguments.command == Command::paper)
    return {paper(arguments.paper, arguments.json, style_of_output())};
  const GraspFile file = read_grasp_file(arguments.file);
  const Grasp<2> grasp = file.grasp();
  if (arguments.command == Command::check)
    return {arguments.json ? check_document(file, grasp)
                           : check_report(file, grasp, style_of_output())};
  for (const std::string& warning : file.warnings)
    std::fputs(("poise: " + warning + "\n").c_str(), stderr);
  if (arguments.command == Command::view) return {view(file, arguments.page)};
  const CurveSettings settings{.domain = arguments.domain.value_or(file.domain),
                               .force_cap = arguments.force_cap};
  switch (arguments.command) {
    case Command::hold:
      return answer_hold(arguments, file, grasp);
    case Command::best:
      return answer_best(arguments, file, grasp, settings);
    default:
      return answer_curve(arguments, file, grasp, settings);
  }
}

}  // namespace poise
