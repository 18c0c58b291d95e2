#pragma once

#include <string>

namespace poise {

/// Answers a request: {"command": "check" | "hold" | "best" | "curve", "grasp": {a grasp file},
/// "angle_deg": for hold, "domain", "force_cap"}, all but the first two optional.
///
/// The answer is the document that the command line prints with --json, or, for a request that
/// makes no sense, {"error": {"path", "line", "column", "problem", "message"}}: where in the
/// request, or, within the grasp, where in the grasp file.
std::string answer(const std::string& request);

}  // namespace poise
