// How hard must the fingers press, as the part is held now?
#include <cstdio>

#include "poise/grip.hpp"
#include "poise/posture.hpp"

int main() {
  // An L-shaped part of 0.13 kg, its upright leg between two fingers. Metres, newtons.
  const poise::Load<2> part{.weight = 0.13 * poise::standard_gravity, .com = {0.02, 0.03}};
  const poise::Contact<2> left{
      .position = {0, 0.045}, .normal = {1, 0}, .friction = 0.6, .finger = "left"};
  const poise::Contact<2> right{
      .position = {0.02, 0.045}, .normal = {-1, 0}, .friction = 0.6, .finger = "right"};
  const poise::Grasp<2> grasp(part, {left, right});

  // The posture: which direction of the part points up, when it is turned clockwise by 0.2 rad.
  const poise::Hold<2> hold = poise::hold(grasp, poise::up_at(-0.2));
  std::printf("grip %.3f N, effort %.2f N^2, at least %.2f N^2\n", poise::grip<2>(grasp, hold),
              hold.effort, hold.lower_bound);
  for (std::size_t i = 0; i < hold.forces.size(); ++i) {
    const poise::ContactForce<2>& force = hold.forces[i];
    std::printf("%s: normal %.3f N, tangential %.3f N, %s\n", grasp.contacts()[i].finger.c_str(),
                force.normal, force.tangential, poise::to_string(force.state));
  }
}
