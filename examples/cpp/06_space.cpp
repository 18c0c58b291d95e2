// A part between the soft jaws of a gripper, which may carry a tool: how to turn the wrist?
#include <cstdio>
#include <numbers>

#include "poise/best_posture.hpp"

int main() {
  constexpr double degree = std::numbers::pi / 180;
  const poise::Contact<3> left{.position = {-0.01, 0.03, 0},
                               .normal = {0, -1, 0},
                               .friction = 0.5,
                               .finger = "left",
                               .torsion = 0.004};
  const poise::Contact<3> right{.position = {-0.01, -0.03, 0},
                                .normal = {0, 1, 0},
                                .friction = 0.5,
                                .finger = "right",
                                .torsion = 0.004};
  const poise::Grasp<3> bare({.weight = 8, .com = {0.005, 0.002, 0}}, {left, right});
  const poise::Grasp<3> with_tool({.weight = 11, .com = {0.03, 0.002, 0}}, {left, right});

  const poise::Vector<3> now = poise::Vector<3>::UnitZ();
  const poise::Hold<3> upright = poise::hold(with_tool, now);
  std::printf("now: grip force %.3f N\n", poise::grip_force(with_tool, upright));

  // The posture whose worst scenario needs least, by at most 60 degrees from the present one.
  const poise::SpatialSettings settings{.gap = 1e-4, .tilt = poise::Tilt{now, 60 * degree}};
  const poise::Best<3> best = poise::best_posture({bare, with_tool}, settings);
  std::printf("%s, proven to %.0e of the effort\n", poise::to_string(best.status), settings.gap);
  for (const double effort : best.best().scenario_efforts)
    std::printf("force norm %.3f N\n", std::sqrt(effort));
  std::printf("best: grip force %.3f N, %s\n", poise::grip_force(with_tool, best.best().hold()),
              poise::to_string(best.best().manner));

  const Eigen::Quaterniond turn =
      poise::smallest_turn(Eigen::Quaterniond::Identity(), best.best().up);
  std::printf("turn by %.1f degrees\n", 2 * std::acos(turn.w()) / degree);
}
