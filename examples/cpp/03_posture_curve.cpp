// The least effort over all postures: a formula on each arc.
#include <cstdio>
#include <numbers>

#include "poise/posture_curve.hpp"

int main() {
  constexpr double degree = std::numbers::pi / 180;
  // A disk between two fingers, 75 degrees to either side of its top, one of them slippery.
  const double x = std::sin(75 * degree), y = std::cos(75 * degree);
  const poise::Contact<2> right{.position = {x, y}, .normal = {-x, -y}, .friction = 1};
  const poise::Contact<2> left{.position = {-x, y}, .normal = {x, -y}, .friction = 0.5773503};
  const poise::Grasp<2> grasp({.weight = 10}, {right, left});

  const poise::PostureCurve curve = poise::posture_curve(grasp);
  for (const poise::Interval& held : curve.holdable)
    std::printf("can be held from %.2f to %.2f degrees\n", held.from / degree, held.to / degree);
  for (const poise::Arc& arc : curve.arcs)
    std::printf("%7.2f to %7.2f: V = %.2f %+.2f cos 2t %+.2f sin 2t\n", arc.from / degree,
                arc.to / degree, arc.value.c0, arc.value.cos2, arc.value.sin2);
  for (const poise::Optimum& optimum : curve.optima)
    std::printf("%s at %.2f: V = %.2f, %s\n", optimum.maximum ? "maximum" : "minimum",
                optimum.angle / degree, optimum.value, poise::to_string(optimum.kind));
}
