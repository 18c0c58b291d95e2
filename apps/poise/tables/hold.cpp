// What `poise hold` says.
#include <fmt/core.h>

#include <cmath>

#include "tables/parts.hpp"
#include "tables/report.hpp"

namespace poise {

template <int Dim>
std::string report(const FileOf<Dim>& file, const Grasp<Dim>& grasp, const HoldAnswer<Dim>& answer,
                   const Style& style) {
  const Posture<Dim>& posture = answer.posture;
  const std::string place = place_text(posture.up);
  const std::string loads = loads_table(grasp, posture, style);
  if (!posture.holdable())
    return title(file.name, style) +
           wrapped(place + " it cannot be held: " + reason_text(grasp, posture) + ".") + loads;
  const std::optional<double> grip = grip_of(grasp, posture);
  const std::string norm = newtons(std::sqrt(posture.effort()));
  const std::string least = posture.hold().objective == Objective::grip
                                ? "the grip to command is " + style.bold(grip_text(grasp, *grip))
                            : grip ? "grip " + style.bold(grip_text(grasp, *grip))
                                   : "force norm " + style.bold(norm);
  return title(file.name, style) +
         fmt::format("{}: {}, {}\n", place, least, to_string(posture.manner)) +
         drives_table(grasp, posture.hold(), style) +
         heading("Forces" + load_text(grasp, posture.decides), style) +
         forces_table(grasp, posture.hold(), style) +
         fmt::format("\nForce norm {}, effort {} N².\n", norm, plain(posture.effort())) + loads;
}

template std::string report(const PlanarFile&, const Grasp<2>&, const HoldAnswer<2>&, const Style&);
template std::string report(const SpatialFile&, const Grasp<3>&, const HoldAnswer<3>&,
                            const Style&);

}  // namespace poise
