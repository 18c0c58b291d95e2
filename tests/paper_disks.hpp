// The six sets of parameters of the paper's figures, with values from another source.
#pragma once

#include <cmath>
#include <vector>

#include "apps/paper/disk.hpp"

namespace poise::test {

struct PaperRow {
  study::HeldDisk disk;
  double theta_b_deg, alpha_b, V_b;
  double rounding;  ///< of V_b
};

inline constexpr double root3 = 1.7320508075688772;
inline const std::vector<PaperRow> paper_table{
    {{.phi = study::pi / 3, .mu1 = root3, .mu2 = root3}, 0, 12.2474, 200, 1e-9},
    {{.phi = study::pi / 3, .mu1 = 1, .mu2 = 1}, 0, 26.3896, 746.4102, 5e-5},
    {{.phi = study::pi / 3, .mu1 = 1 / root3 + 0.01, .mu2 = 1 / root3 + 0.01},
     0,
     946.8915,
     896653.56,
     0.005},
    {{.phi = 5 * study::pi / 12, .mu1 = 1, .mu2 = 1}, 0, 12.2474, 200, 1e-9},
    {{.phi = study::pi / 4, .mu1 = 1.01, .mu2 = 1.01}, 0, 1421.2846, 2020100, 0.05},
    {{.phi = 5 * study::pi / 12, .mu1 = 1, .mu2 = 1 / root3}, 30, 15.7830, 300, 1e-9},
};

}  // namespace poise::test
