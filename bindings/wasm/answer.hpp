#pragma once

#include <string>

namespace poise {

/// Answers a request: {"command", "grasp": {a grasp file}} and what the command may have besides.
///
/// `check`, `hold` ("angle_deg", in space "up"), `best` and `curve` ("domain", "force_cap") give
/// the document that the command line prints with --json.
///   margins  ("angle_deg", in space "up"): {"weight", "holdable", "greatest_weight",
///            "friction_factor"}: the greatest weight that is still held in the posture, null where
///            any is, and the least common factor on all frictions, null where none is enough; in
///            the scenario that decides
/// In space also
///   efforts  {"ups": [[x, y, z], ...]}: {"efforts": [V or null, ...]} [N^2], each hold started at
///            the one before
///   planes   {"cuts": those of best}: {"planes": [{"a", "b"}, ...]}: for every x in R^3 the effort
///            of the load x (1 is the weight) is at least a . x - b [N^2]; of the planes of a tilt
///            a . x <= 0
/// And {"command": "read", "bytes", "file"} gives the grasp file in JSON and SI units that a file
/// in YAML or JSON spells; its bytes are in hexadecimal digits, and left out where there are none.
///
/// For a request that makes no sense: {"error": {"path", "line", "column", "problem", "message"}},
/// where in the request, or, within the grasp, where in the grasp file.
std::string answer(const std::string& request);

}  // namespace poise
