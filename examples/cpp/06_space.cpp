// A part between the soft jaws of a gripper, which may carry a tool: how to turn the wrist?
#include <cstdio>
#include <numbers>
#include <vector>

#include "poise/best_posture.hpp"
#include "poise/grip.hpp"
#include "poise/turn.hpp"

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
  const poise::Load<3> bare{.weight = 8, .com = {0.005, 0.002, 0}};
  const poise::Load<3> with_tool{.weight = 11, .com = {0.03, 0.002, 0}};
  const poise::Grasp<3> grasp(std::vector{bare, with_tool}, {left, right});

  const poise::Vector<3> now = poise::Vector<3>::UnitZ();
  std::printf("now: grip %.3f N\n", poise::grip<3>(grasp, poise::posture_at(grasp, now).hold()));

  // The posture whose worst load needs least, by at most 60 degrees from the present one.
  const poise::SpatialSettings settings{.gap = 1e-4, .tilt = poise::Tilt{now, 60 * degree}};
  const poise::Best<3> best = poise::best_posture(grasp, settings);
  std::printf("%s, proven to %.0e of the effort\n", poise::to_string(best.status), settings.gap);
  for (const poise::Hold<3>& hold : best.best().holds)
    std::printf("force norm %.3f N\n", std::sqrt(hold.effort));
  std::printf("best: grip %.3f N, %s\n", poise::grip<3>(grasp, best.best().hold()),
              poise::to_string(best.best().manner));

  const poise::Turn turn = poise::turn_to(Eigen::Quaterniond::Identity(), best.best().up);
  std::printf("turn by %.1f degrees\n", turn.angle / degree);
}
