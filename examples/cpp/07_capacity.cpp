// What can a gripper hold? A block between two jaws, of which the left presses with at most 25 N.
#include <cstdio>

#include "poise/capacity.hpp"

int main() {
  const poise::Contact<2> left{.position = {-0.03, 0},
                               .normal = {1, 0},
                               .friction = 0.4,
                               .max_normal = 25,
                               .finger = "left"};
  const poise::Contact<2> right{
      .position = {0.03, 0}, .normal = {-1, 0}, .friction = 0.6, .finger = "right"};
  const poise::Grasp<2> grasp({.weight = 10, .com = {0, 0}}, {left, right});
  const poise::Vector<2> up = poise::up_at(0);

  const poise::Capacity<2> capacity = poise::capacity(grasp, up, 1.5);
  std::printf("greatest weight %.3f N\n", capacity.weights.greatest.weight);
  std::printf("greatest safety on the friction %.3f\n", 1 / capacity.friction.factor);
  std::printf("grip force to command %.3f N\n", poise::grip_force(grasp, capacity.safe));

  // What would help? What one more newton of a jaw brings, as the proof says.
  const std::vector<poise::Deciding> decide =
      poise::deciding(grasp, up, capacity.weights.greatest.dual);
  for (std::size_t i = 0; i < decide.size(); ++i)
    std::printf("%s: %.3f N more for each newton\n", grasp.contacts()[i].finger.c_str(),
                decide[i].per_newton);
}
