// The dual of holding in space: docs/theory.md, "Space".
#include <limits>

#include "dual/maximise.hpp"

namespace poise::dual {

Twist<3> cold_start(const Problem<3>& problem, const Wrench<3>& w) {
  return problem.hand.inverse * w;
}

// A weak pull towards y = 0 gives the direction, but for what else y has to do. A pull that is ten
// times weaker makes only the direction ten times longer.
bool separate(const Problem<3>& problem, const Wrench<3>& w, double force_cap, Point<3>& point) {
  Point<3> pulled(problem.size);
  ascend<3, double>(problem, w, Twist<3>::Zero(), {.pull = weak_pull}, pulled);
  const Twist<3> first = pulled.y;
  ascend<3, double>(problem, w, Twist<3>(10 * first), {.pull = 0.1 * weak_pull}, pulled);
  const Twist<3> second = pulled.y;
  return prove_along<3, double>(problem, w, second - first, force_cap, point) ||
         prove_along<3, double>(problem, w, second, force_cap, point);
}

bool approach(const Problem<3>& problem, const Wrench<3>& w, const Twist<3>& start,
              double force_cap, Point<3>& point) {
  const Aim rough{.force_cap = force_cap, .digits = Digits::rough};
  if (!ascend<3, double>(problem, w, start_from<3>(problem, w, start), rough, point)) {
    separate(problem, w, force_cap, point);
    return false;
  }
  if (l1_norm(point.y) < 1e4 * (1 + point.value)) return true;
  // Rounding of a load at the border of what can be held may ask for a very long y.
  Point<3> pulled(problem.size);
  ascend<3, double>(problem, w, cold_start(problem, w), {.pull = faint_pull}, pulled);
  pulled.residual += faint_pull * pulled.y;
  if (primal_norm<3, double>(pulled.residual) <= 0.4 * delta) {
    pulled.value = pulled.y.dot(w) - pulled.y.dot(w - pulled.residual) + 0.5 * squared_norm(pulled);
    point = pulled;
  }
  return true;
}

template void evaluate(const Cones<3>&, const Wrench<3>&, const Twist<3>&, Point<3>&);
template Square<3, double> curvature(const Cones<3>&, const Point<3>&);
template bool maximise(const Problem<3>&, const Wrench<3>&, const Twist<3>&, double, Point<3>&);

}  // namespace poise::dual
