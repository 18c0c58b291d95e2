#pragma once

#include <string>

namespace poise {

/// Answers a request: {"command", "grasp": {a grasp file}} and what the command may have besides.
///
/// `check`, `hold` ("angle_deg", in space "up"), `turn` (the same: where to), `best` ("with_turn":
/// false leaves out the turn, which takes longer than the rest) and `curve` ("domain", "force_cap")
/// give the document that the command line prints with --json. "objective" is grip or effort, else
/// that of the file; of a hand without a grip the answer is that for effort, as its options say.
///   margins  ("angle_deg", in space "up"): {"weight", "holdable", "greatest_weight",
///            "friction_factor"}: the greatest weight that is still held in the posture, null where
///            any is, and the least common factor on all frictions, null where none is enough; in
///            the load that decides
///   objectives: {"objective", "grip_unit"}: that of the file, and "N", "N m" or "of max"; null
///            where the hand has no grip
/// In space also
///   values   {"ups": [[x, y, z], ...]}: {"objective", "values": [F or V [N^2], or null, ...]}
///   planes   {"cuts": those of best}: {"objective", "planes": [{"a", "b", "rate"}, ...]}: for
///            every x in R^3 the value of the load x (1 is the weight) times rate is at least
///            a . x - b
/// And {"command": "read", "bytes", "file"} gives the grasp file in JSON and SI units that a file
/// in YAML or JSON spells; its bytes are in hexadecimal digits, and left out where there are none.
///
/// For a request that makes no sense: {"error": {"path", "line", "column", "problem", "message"}},
/// where in the request, or, within the grasp, where in the grasp file.
std::string answer(const std::string& request);

}  // namespace poise
