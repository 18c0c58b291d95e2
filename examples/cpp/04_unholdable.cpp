// What cannot be held is an answer, too: with the reason, and a proof to be checked by hand.
#include <algorithm>
#include <cstdio>

#include "poise/posture.hpp"

int main() {
  // A cube of 1 kg between two slippery fingers that are not opposite to each other.
  const poise::Load<2> cube{.weight = 9.80665, .com = {0, 0}};
  const poise::Contact<2> left{.position = {-0.05, 0.02}, .normal = {1, 0}, .friction = 0.1};
  const poise::Contact<2> right{.position = {0.05, -0.02}, .normal = {-1, 0}, .friction = 0.1};
  const poise::Grasp<2> grasp(cube, {left, right});

  const poise::Vector<2> up = poise::up_at(0);
  const poise::Hold<2> hold = poise::hold(grasp, up);
  std::printf("%s\n", hold.holdable ? "can be held" : "cannot be held");
  std::printf("%s\n", poise::reason(grasp, hold).c_str());

  // The proof is a motion y on which gravity works, and along which no finger can push back.
  const poise::Twist<2>& y = hold.dual;
  std::printf("the weight drives it: %s\n", y.dot(grasp.loads().front().at(up)) > 0 ? "yes" : "no");
  const Eigen::VectorXd z = poise::grasp_matrix(grasp).transpose() * y;  // normal, tangential, ...
  double most = 0;
  for (Eigen::Index i = 0; i < z.size() / 2; ++i)
    most = std::max(most, z[2 * i] + grasp.contacts()[static_cast<std::size_t>(i)].friction *
                                         std::abs(z[2 * i + 1]));
  std::printf("a finger opposes it: %s\n", most > 1e-9 * z.norm() ? "yes" : "no");
}
