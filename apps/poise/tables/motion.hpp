// What `poise motion` says.
#pragma once

#include <string>

#include "ask/motion.hpp"
#include "poise/grasp.hpp"
#include "tables/table.hpp"

namespace poise {

std::string report(const std::string& name, const Grasp<3>& grasp, const Body& body,
                   const MotionReport& report, const Style& style);

/// "a grip of 2.125 N", "a force norm of 8.97 N": of V [N^2] or F.
std::string need_text(const Grasp<3>& grasp, Objective objective, double value);

}  // namespace poise
