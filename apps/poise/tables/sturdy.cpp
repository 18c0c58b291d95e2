// What `poise best --objective sturdy` says.
#include <fmt/core.h>

#include <cmath>

#include "poise/turn.hpp"
#include "tables/parts.hpp"
#include "tables/report.hpp"
#include "tables/shake.hpp"
#include "tables/turn.hpp"

namespace poise {

std::string acceleration_text(double acceleration) {
  return fmt::format("{} m/s² ({} g)", plain(acceleration), plain(acceleration / standard_gravity));
}

template <int Dim>
std::string shake_text(const Shake<Dim>& found) {
  if (!found.holdable) return "nothing: the posture itself is not held";
  if (std::isinf(found.acceleration)) return "any acceleration";
  const std::string open =
      found.proven ? ""
      : std::isinf(found.bound)
          ? "; that it is no more is not proven"
          : "; that it is no more is proven only of more than " + acceleration_text(found.bound);
  return acceleration_text(found.acceleration) + " in any direction, weakest along " +
         vector_text(found.direction, 2) + open;
}

template std::string shake_text(const Shake<2>&);
template std::string shake_text(const Shake<3>&);

namespace {

std::string scope(const SturdyAnswer<2>& answer) {
  return answer.domain == Domain::all ? "" : " outside the fork of the fingers";
}
std::string scope(const SturdyAnswer<3>& answer) {
  return answer.tilt ? " " + tilt_text(*answer.tilt) : "";
}

template <int Dim>
std::string how_sure(const SturdyAnswer<Dim>& answer) {
  const Sturdiest<Dim>& found = answer.found;
  if (found.status == Status::optimal)
    return std::isinf(found.bound)
               ? "Nothing limits it: the harder the fingers press, the more."
               : fmt::format(
                     "Proven with {} holds: no posture{} withstands "
                     "more than {}.",
                     found.holds, scope(answer), acceleration_text(found.bound));
  return fmt::format(
      "Not proven: after {} holds a posture{} may exist that withstands {}. More "
      "holds (--max-holds) may tell.",
      found.holds, scope(answer),
      std::isinf(found.bound) ? "any acceleration" : "up to " + acceleration_text(found.bound));
}

std::string how_to_get_there(const PlanarFile& file, const SturdyAnswer<2>& answer) {
  const double angle = angle_of(answer.found.up) - file.angle.value_or(0);
  return turn_text(std::remainder(angle, 2 * M_PI));
}
std::string how_to_get_there(const SpatialFile&, const SturdyAnswer<3>& answer) {
  return turn_text(turn_to(answer.orientation, answer.found.up));
}

std::string rotation_text(const SturdyAnswer<2>&, const Style&) { return ""; }
std::string rotation_text(const SturdyAnswer<3>& answer, const Style& style) {
  const Eigen::Quaterniond turn = turn_to(answer.orientation, answer.found.up).rotation;
  Table table({"w", "x", "y", "z"});
  table.add({fixed(turn.w(), 6), fixed(turn.x(), 6), fixed(turn.y(), 6), fixed(turn.z(), 6)});
  return heading("The turn as a quaternion, in the world frame with +z up", style) +
         table.text(style);
}

}  // namespace

template <int Dim>
std::string report(const FileOf<Dim>& file, const Grasp<Dim>& grasp,
                   const SturdyAnswer<Dim>& answer, const Style& style) {
  const Sturdiest<Dim>& found = answer.found;
  const std::string text = title(file.name, style);
  if (found.shakes.empty())
    return text + wrapped(found.status == Status::unholdable
                              ? "Cannot be held in any posture" + scope(answer) + "."
                              : "Found no posture" + scope(answer) + " in which it can be held. " +
                                    how_sure(answer));
  std::size_t least = 0;
  for (std::size_t k = 1; k < found.shakes.size(); ++k)
    if (found.shakes[k].acceleration < found.shakes[least].acceleration) least = k;
  Table table({"<", Dim == 2 ? "" : "up", "< withstands", "<"});
  if (answer.now) table.add({"now", posture_text(answer.now_up), shake_text(*answer.now), ""});
  table.add({"sturdiest", posture_text(found.up),
             shake_text(found.shakes[least]) + load_text(grasp, least),
             how_to_get_there(file, answer)});
  return text + table.text(style) + "\n" + wrapped(how_sure(answer)) + rotation_text(answer, style);
}

template std::string report(const PlanarFile&, const Grasp<2>&, const SturdyAnswer<2>&,
                            const Style&);
template std::string report(const SpatialFile&, const Grasp<3>&, const SturdyAnswer<3>&,
                            const Style&);

}  // namespace poise
