#include "plane/harmonic.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace poise {
namespace {

using Polynomial = std::vector<double>;  // coefficients, the constant first

double value(const Polynomial& p, double t) {
  double sum = 0;
  for (auto c = p.rbegin(); c != p.rend(); ++c) sum = sum * t + *c;
  return sum;
}

/// The root of continuous g between a and b, where its signs differ.
template <class Function>
Root bisect(const Function& g, double a, double b) {
  const bool rising = g(b) > 0;
  for (int step = 0; step < 200; ++step) {
    const double middle = (a + b) / 2;
    if (middle == a || middle == b) break;
    ((g(middle) > 0) == rising ? b : a) = middle;
  }
  return {(a + b) / 2, rising};
}

/// Between two neighbouring roots of its derivative a polynomial changes its sign at most once.
std::vector<Root> sign_changes(const Polynomial& p, double from, double to) {
  std::vector<double> ends{from};
  if (p.size() > 2) {
    Polynomial slope;
    for (std::size_t k = 1; k < p.size(); ++k) slope.push_back(static_cast<double>(k) * p[k]);
    for (const Root& root : sign_changes(slope, from, to)) ends.push_back(root.at);
  }
  ends.push_back(to);
  std::vector<Root> roots;
  for (std::size_t i = 1; i < ends.size(); ++i)
    if ((value(p, ends[i - 1]) > 0) != (value(p, ends[i]) > 0))
      roots.push_back(bisect([&](double t) { return value(p, t); }, ends[i - 1], ends[i]));
  return roots;
}

}  // namespace

Harmonic2 derivative(const Harmonic2& g) { return {0, g.sin1, -g.cos1, 2 * g.sin2, -2 * g.cos2}; }

Roots sign_changes(const Harmonic2& g, double from, double to) {
  constexpr double half_pi = std::numbers::pi / 2;
  Roots roots;
  if (g.c0 == 0 && g.cos1 == 0 && g.sin1 == 0) {  // cos(2 theta - psi) = 0
    if (g.cos2 == 0 && g.sin2 == 0) return roots;
    const double first = (std::atan2(g.sin2, g.cos2) + half_pi) / 2;
    const double skipped = std::ceil((from - first) / half_pi);
    bool rising = std::fmod(skipped, 2) != 0;  // at `first` it falls
    for (double k = skipped; first + k * half_pi < to; ++k, rising = !rising)
      if (first + k * half_pi > from) roots.push_back({first + k * half_pi, rising});
    return roots;
  }
  const double middle = from + off_middle * (to - from);
  if (to - from > 3) {  // tan below would be too large
    roots = sign_changes(g, from, middle);
    for (const Root& root : sign_changes(g, middle, to)) roots.push_back(root);
    return roots;
  }
  // t = tan((theta - middle) / 2) makes it a quartic.
  const double c = std::cos(middle), s = std::sin(middle);
  const double cc = std::cos(2 * middle), ss = std::sin(2 * middle);
  const double cos1 = g.cos1 * c + g.sin1 * s, sin1 = g.sin1 * c - g.cos1 * s;
  const double cos2 = g.cos2 * cc + g.sin2 * ss, sin2 = g.sin2 * cc - g.cos2 * ss;
  const Polynomial quartic{g.c0 + cos1 + cos2, 2 * sin1 + 4 * sin2, 2 * g.c0 - 6 * cos2,
                           2 * sin1 - 4 * sin2, g.c0 - cos1 + cos2};
  const double first = std::tan((from - middle) / 2), last = std::tan((to - middle) / 2);
  for (const Root& root : sign_changes(quartic, first, last))
    roots.push_back({middle + 2 * std::atan(root.at), root.rising});
  return roots;
}

}  // namespace poise
