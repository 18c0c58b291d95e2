#include "verify/hull.hpp"

#include <libqhull_r/qhull_ra.h>

#include <cstdio>

namespace poise::verify {

std::optional<std::vector<Facet>> hull(const std::vector<Vec>& points) {
  if (points.size() < 4) return {};
  std::vector<coordT> coordinates;
  for (const Vec& point : points)
    for (const Real x : point) coordinates.push_back(static_cast<coordT>(x));
  std::FILE* const silent = std::tmpfile();  // Qhull tells of flat points at length
  qhT qhull;
  qh_zero(&qhull, silent);
  char command[] = "qhull Qt";
  const int error = qh_new_qhull(&qhull, 3, static_cast<int>(points.size()), coordinates.data(), 0,
                                 command, nullptr, silent);
  std::vector<Facet> facets;
  if (error == 0) {
    for (const facetT* facet = qhull.facet_list; facet && facet->next; facet = facet->next) {
      Vec normal(3);
      normal << facet->normal[0], facet->normal[1], facet->normal[2];
      facets.push_back({normal, facet->offset});
    }
  }
  qh_freeqhull(&qhull, qh_ALL);
  int current = 0, total = 0;
  qh_memfreeshort(&qhull, &current, &total);
  if (silent) std::fclose(silent);
  if (error != 0) return {};
  return facets;
}

}  // namespace poise::verify
