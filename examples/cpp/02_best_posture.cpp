// How should the part be turned, so that the fingers press least?
#include <cstdio>
#include <numbers>

#include "poise/best_posture.hpp"
#include "poise/grip.hpp"

namespace {

void print(const char* what, const poise::Grasp<2>& grasp, const poise::Minimum<2>& posture) {
  std::printf("%s: turned by %.2f degrees, %s: grip %.3f N\n", what,
              posture.optimum.angle * 180 / std::numbers::pi, poise::to_string(posture.manner),
              poise::grip<2>(grasp, posture.hold()));
}

}  // namespace

int main() {
  const poise::Load<2> part{.weight = 0.13 * poise::standard_gravity, .com = {0.02, 0.03}};
  const poise::Contact<2> left{.position = {0, 0.045}, .normal = {1, 0}, .friction = 0.6};
  const poise::Contact<2> right{.position = {0.02, 0.045}, .normal = {-1, 0}, .friction = 0.6};
  const poise::Grasp<2> grasp(part, {left, right});

  const poise::Best<2> best = poise::best_posture(grasp);
  print("best", grasp, best.best());
  print("best pinched", grasp, *best.best_pinched());
  print("worst", grasp, *best.proof.worst);
}
