// What can be asked of a grasp: one type for the program, the page, Python and batch.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "poise/best_posture.hpp"

namespace poise {

enum class Command { check, hold, best, turn, curve, capacity, sturdiest };

/// A question; what is not given is taken from the grasp file, else it has its default.
struct Question {
  Command command{Command::best};
  std::optional<double>
      angle_deg{};                 ///< the posture in the plane, as it was given; of turn its end
  std::vector<double> up{};        ///< or its direction, as it was given: 2 or 3 numbers
  std::optional<Domain> domain{};  ///< in the plane
  std::optional<Objective> objective{};
  double force_cap{HoldSettings{}.force_cap};  ///< in weights of the heaviest load
  std::optional<double> gap{};  ///< in space, as are all below but the safety; of sturdiest always
  std::optional<int> max_holds{};
  std::optional<Vector<3>> tilt_from{};
  std::optional<double> tilt_max_deg{};
  std::optional<Eigen::Quaterniond> orientation{};  ///< the present one, object to world
  bool with_turn{true};          ///< best: whether to look at the turn; turn: at other ways
  double safety{1.5};            ///< of capacity
  std::optional<double> grip{};  ///< of capacity: what drives give at most to what shakes and tilts
};

}  // namespace poise
