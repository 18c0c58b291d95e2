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
  const poise::Load<2> block{.weight = 10, .com = {0, 0}};
  const poise::Hand<2> hand({left, right}, block.com);

  const poise::Capacity<2> capacity = poise::capacity(hand, block, poise::up_at(0), 1.5);
  std::printf("greatest weight %.3f N\n", capacity.weights.greatest.weight);
  std::printf("greatest safety on the friction %.3f\n", 1 / capacity.friction.factor);
  std::printf("grip to command %.3f N\n", capacity.safe.hold().grip);

  // What would help? What one more newton of a jaw brings, as the proof says.
  const std::vector<poise::Deciding>& deciding = capacity.weights.deciding;
  for (std::size_t i = 0; i < deciding.size(); ++i)
    std::printf("%s: %.3f N more for each newton\n", hand.contacts()[i].finger.c_str(),
                deciding[i].per_newton);
}
