#include "commands.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "data/acronym.hpp"
#include "files/grasp_writer.hpp"
#include "files/result.hpp"
#include "files/spatial.hpp"
#include "paper.hpp"
#include "picture.hpp"
#include "plot.hpp"
#include "report.hpp"
#include "spatial_picture.hpp"
#include "verify.hpp"
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

constexpr double degree = 3.14159265358979323846 / 180;

void warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings)
    std::fputs(("poise: " + warning + "\n").c_str(), stderr);
}

Answer answer_hold(const Arguments& arguments, const PlanarFile& file, const Grasp<2>& grasp) {
  PostureOption option{.angle_deg = arguments.angle_deg};
  if (!arguments.up.empty()) option.up = Vector<2>(arguments.up[0], arguments.up[1]);
  const double theta = option.up          ? angle_of(*option.up)
                       : option.angle_deg ? *option.angle_deg * degree
                                          : file.angle.value_or(0);
  const HoldSettings settings{.force_cap = arguments.force_cap};
  const Hold<2> result = hold(grasp, up_at(theta), settings);
  return {arguments.json ? hold_document(grasp, theta, result, settings, option)
                         : hold_report(file, grasp, theta, result, style_of_output()),
          result.holdable};
}

Answer answer_best(const Arguments& arguments, const PlanarFile& file, const Grasp<2>& grasp,
                   const CurveSettings& settings) {
  const BestPosture best = best_posture(grasp, settings);
  return {arguments.json ? best_document(grasp, best, settings)
                         : best_report(file, grasp, best, settings, style_of_output()),
          best.holdable()};
}

Answer answer_curve(const Arguments& arguments, const PlanarFile& file, const Grasp<2>& grasp,
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

/// A posture that was asked for, and which one it is.
template <int Dim>
struct Chosen {
  std::string which;  ///< given, now, best or upright
  Vector<Dim> up;
};

/// The one given; else that of the file and the best one.
std::vector<Chosen<2>> postures(const Arguments& arguments, const PlanarFile& file,
                                const Grasp<2>& grasp) {
  if (!arguments.up.empty())
    return {{"given", Vector<2>(arguments.up[0], arguments.up[1]).stableNormalized()}};
  if (arguments.angle_deg) return {{"given", up_at(*arguments.angle_deg * degree)}};
  std::vector<Chosen<2>> chosen;
  if (file.angle) chosen.push_back({"now", up_at(*file.angle)});
  const BestPosture best =
      best_posture(grasp, {.domain = file.domain, .force_cap = arguments.force_cap});
  if (best.holdable()) chosen.push_back({"best", up_at(best.best().optimum.angle)});
  if (chosen.empty()) chosen.push_back({"upright", up_at(0)});
  return chosen;
}

std::vector<Chosen<3>> postures(const Arguments& arguments, const SpatialFile& file,
                                const std::vector<Grasp<3>>& grasps) {
  if (!arguments.up.empty()) return {{"given", Vector<3>(arguments.up.data()).stableNormalized()}};
  std::vector<Chosen<3>> chosen;
  if (file.up) chosen.push_back({"now", *file.up});
  SpatialSettings settings;
  settings.force_cap = arguments.force_cap;
  settings.tilt = file.tilt;
  settings.starts = 0;
  const BestSpatialPosture best = best_posture(grasps, settings);
  if (best.best) chosen.push_back({"best", best.best->up});
  if (chosen.empty()) chosen.push_back({"upright", Vector<3>::UnitZ()});
  return chosen;
}

template <int Dim>
Answer answer_capacity(const Arguments& arguments, const CommonFile<Dim>& file,
                       const std::vector<Grasp<Dim>>& grasps,
                       const std::vector<Chosen<Dim>>& chosen) {
  const HoldSettings settings{.force_cap = arguments.force_cap};
  std::vector<CapacityAt<Dim>> answers;
  bool holds = false;  // in some posture, in all scenarios
  for (const Chosen<Dim>& posture : chosen) {
    bool all = true;
    for (std::size_t k = 0; k < grasps.size(); ++k) {
      answers.push_back({posture.which, posture.up, k,
                         capacity(grasps[k], posture.up, arguments.safety, settings)});
      all = all && answers.back().capacity.friction.factor <= 1;
    }
    holds = holds || all;
  }
  const CapacityOptions options{arguments.force_cap, arguments.safety, arguments.angle_deg,
                                arguments.up};
  return {arguments.json ? capacity_document(grasps, answers, options)
                         : capacity_report(file, grasps, answers, options, style_of_output()),
          holds};
}

/// What a picture shows, in a line.
std::string caption(const std::string& which, const std::string& posture,
                    const std::optional<double>& grip_force, Manner manner) {
  const std::string words = which == "now"    ? "as it is held now, " + posture
                            : which == "best" ? "best posture, " + posture
                                              : posture;
  return words + ": " +
         (grip_force ? "grip force " + newtons(*grip_force) + ", " + to_string(manner)
                     : "cannot be held");
}

Answer answer_draw(const Arguments& arguments, const PlanarFile& file, const Grasp<2>& grasp) {
  const Chosen<2> chosen = postures(arguments, file, grasp).front();
  const Hold<2> there = hold(grasp, chosen.up, {.force_cap = arguments.force_cap});
  std::optional<double> grip;
  if (there.holdable) grip = grip_force(grasp, there);
  const Manner how = there.holdable ? manner(grasp, chosen.up, there) : Manner::resting;
  const std::string words =
      caption(chosen.which, "at " + degrees_text(angle_of(chosen.up)), grip, how);
  draw(planar_picture(file, grasp, chosen.up, there, words, arguments.out.ends_with(".svg")),
       arguments.out);
  return {"Drawn in " + arguments.out + "\n", there.holdable};
}

Answer answer_draw(const Arguments& arguments, const SpatialFile& file,
                   const std::vector<Grasp<3>>& grasps) {
  const Chosen<3> chosen = postures(arguments, file, grasps).front();
  const SpatialPosture posture = hold_all(grasps, chosen.up, {.force_cap = arguments.force_cap});
  const Grasp<3>& grasp = grasps[posture.scenario];
  std::optional<double> grip;
  if (posture.hold.holdable) grip = grip_force(grasp, posture.hold);
  std::string words =
      caption(chosen.which, "with " + vector_text(chosen.up, 3) + " up", grip, posture.manner);
  if (grasps.size() > 1) words += ", in scenario " + std::to_string(posture.scenario);
  write_file(spatial_picture(file, grasp, posture, words, arguments.out.ends_with(".svg")),
             arguments.out);
  return {"Drawn in " + arguments.out + "\n", posture.hold.holdable};
}

Answer answer_in(const PlanarFile& file, const Arguments& arguments) {
  for (const auto& [given, flag] : {std::pair(arguments.gap.has_value(), "--gap"),
                                    {arguments.max_holds.has_value(), "--max-holds"},
                                    {arguments.tilt_from.has_value(), "--tilt-from"},
                                    {arguments.tilt_max_deg.has_value(), "--tilt-max"},
                                    {arguments.orientation.has_value(), "--orientation"}})
    if (given)
      throw UsageError(std::string(flag) + ": is for space, " + arguments.file +
                       " is in the plane (dimension 2)");
  if (arguments.up.size() == 3)
    throw UsageError("--up: has 3 numbers, must have 2: " + arguments.file +
                     " is in the plane (dimension 2)");
  const Grasp<2> grasp = file.grasp();
  const CurveSettings settings{.domain = arguments.domain.value_or(file.domain),
                               .force_cap = arguments.force_cap};
  switch (arguments.command) {
    case Command::check:
      return {arguments.json ? check_document(file, grasp)
                             : check_report(file, grasp, style_of_output())};
    case Command::hold:
      return answer_hold(arguments, file, grasp);
    case Command::best:
      return answer_best(arguments, file, grasp, settings);
    case Command::capacity:
      return answer_capacity<2>(arguments, file, {grasp}, postures(arguments, file, grasp));
    case Command::draw:
      return answer_draw(arguments, file, grasp);
    case Command::view:
      return {view(file, arguments.page)};
    default:
      return answer_curve(arguments, file, grasp, settings);
  }
}

Answer answer_hold(const Arguments& arguments, const SpatialFile& file,
                   const std::vector<Grasp<3>>& grasps) {
  std::optional<Vector<3>> option;
  if (!arguments.up.empty()) option = Vector<3>(arguments.up.data());
  const Vector<3> up =
      option ? option->stableNormalized() : file.up.value_or(Vector<3>(Vector<3>::UnitZ()));
  const HoldSettings settings{.force_cap = arguments.force_cap};
  const SpatialPosture posture = hold_all(grasps, up, settings);
  return {arguments.json ? hold_document(grasps, posture, settings, option)
                         : hold_report(file, grasps, posture, settings, style_of_output()),
          posture.hold.holdable};
}

/// That of the file, or what the flags make of it.
std::optional<Tilt> tilt_of(const Arguments& arguments, const SpatialFile& file) {
  if (!arguments.tilt_from && !arguments.tilt_max_deg) return file.tilt;
  if (!file.tilt && !arguments.tilt_max_deg)
    throw UsageError("--tilt-from: needs --tilt-max, or a tilt in " + arguments.file);
  if (!file.tilt && !arguments.tilt_from)
    throw UsageError("--tilt-max: needs --tilt-from, or a tilt in " + arguments.file);
  Tilt tilt = file.tilt.value_or(Tilt{});
  if (arguments.tilt_from) tilt.from = *arguments.tilt_from;
  if (arguments.tilt_max_deg) tilt.most = *arguments.tilt_max_deg * degree;
  return tilt;
}

Answer answer_best(const Arguments& arguments, const SpatialFile& file,
                   const std::vector<Grasp<3>>& grasps) {
  SpatialSettings settings;
  settings.force_cap = arguments.force_cap;
  settings.gap = arguments.gap.value_or(settings.gap);
  settings.max_holds = arguments.max_holds.value_or(settings.max_holds);
  settings.tilt = tilt_of(arguments, file);
  const Present present{arguments.orientation ? *arguments.orientation
                        : file.up             ? orientation_of(*file.up)
                                              : Eigen::Quaterniond::Identity(),
                        arguments.orientation || file.up};
  const BestSpatialPosture best = best_posture(grasps, settings);
  return {arguments.json ? best_document(grasps, best, settings, present.orientation)
                         : best_report(file, grasps, best, settings, present, style_of_output()),
          best.best.has_value()};
}

Answer answer_in(const SpatialFile& file, const Arguments& arguments) {
  const std::string in_space = arguments.file + " is in space (dimension 3)";
  if (arguments.command == Command::curve)
    throw UsageError("curve: is for the plane, " + in_space +
                     ", where postures make no curve: ask for best");
  if (arguments.command == Command::view)
    throw UsageError("view: is for the plane, " + in_space + ", which the page does not show yet");
  if (arguments.angle_deg)
    throw UsageError("--angle: is for the plane, " + in_space + ": give --up X,Y,Z");
  if (arguments.up.size() == 2) throw UsageError("--up: has 2 numbers, must have 3: " + in_space);
  if (arguments.domain.value_or(Domain::all) == Domain::pinched)
    throw UsageError("--domain: pinched is for the plane, " + in_space +
                     ", where best_pinched is shown anyway");
  const std::vector<Grasp<3>> grasps = file.grasps();
  if (arguments.command == Command::check)
    return {arguments.json ? check_document(file, grasps)
                           : check_report(file, grasps, style_of_output())};
  if (arguments.command == Command::draw) return answer_draw(arguments, file, grasps);
  if (arguments.command == Command::capacity)
    return answer_capacity<3>(arguments, file, grasps, postures(arguments, file, grasps));
  return arguments.command == Command::hold ? answer_hold(arguments, file, grasps)
                                            : answer_best(arguments, file, grasps);
}

/// The folder that a grasp file is written to; what is printed is taken to go to the present one.
std::string folder_of(const std::string& out) {
  return out.empty() ? "." : std::filesystem::absolute(out).parent_path().string();
}

/// A grasp file, printed or written.
Answer printed_or_written(const std::string& text, const std::string& out) {
  if (out.empty()) return {text};
  write_file(text, out);
  return {"Wrote " + out + "\n"};
}

/// A grasp file with the contacts that its gripper makes.
Answer answer_contacts(const Arguments& arguments, const PlanarFile& file) {
  return printed_or_written(grasp_document(file), arguments.out);
}
Answer answer_contacts(const Arguments& arguments, const SpatialFile& file) {
  return printed_or_written(grasp_document(file, Held::by_contacts, folder_of(arguments.out)),
                            arguments.out);
}

Answer answer_import(const Arguments& arguments) {
  const Acronym data(arguments.file, arguments.mesh_root);
  if (arguments.grasp >= data.size())
    throw UsageError("--grasp: is " + std::to_string(arguments.grasp) + ", " + arguments.file +
                     " has " + std::to_string(data.size()) + " grasps, the first is 0");
  try {
    const SpatialFile file = data.grasp(arguments.grasp);
    warn(file.warnings);
    return printed_or_written(grasp_document(file, Held::by_gripper, folder_of(arguments.out)),
                              arguments.out);
  } catch (const MissedGrip& missed) {
    throw FileError(arguments.file, {}, "grasp " + std::to_string(arguments.grasp), missed.what());
  }
}

}  // namespace

Answer answer(const Arguments& arguments) {
  if (arguments.command == Command::paper)
    return {paper(arguments.paper, arguments.json, style_of_output())};
  if (arguments.command == Command::import) return answer_import(arguments);
  const GraspFile any = read_grasp_file(arguments.file);
  if (arguments.command == Command::verify) {
    const Verdict checked = verdict(any, arguments.result, arguments.json, style_of_output());
    return {checked.text, checked.confirmed};
  }
  return std::visit(
      [&](const auto& file) {
        if (arguments.command != Command::check) warn(file.warnings);
        if (arguments.command == Command::contacts) return answer_contacts(arguments, file);
        return answer_in(file, arguments);
      },
      any);
}

}  // namespace poise
