// Whole answers in space for grasps decoded from bytes, extreme and degenerate ones on purpose:
// what is asserted of numbers here holds always; where sizes are moderate, verify confirms all.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "decoder.hpp"
#include "files/grasp_writer.hpp"
#include "poise/turn.hpp"
#include "verify/verify.hpp"

namespace poise {
namespace {

Vector<3> direction(Decoder& decoder) {
  const double turn = decoder.angle(), height = std::sin(decoder.angle());
  const double r = std::sqrt(1 - height * height);
  return {r * std::cos(turn), r * std::sin(turn), height};
}

SpatialFile question(Decoder& decoder) {
  SpatialFile file;
  file.loads = {decoder.object<3>()};
  if (decoder.one_in(4)) file.loads.push_back(decoder.object<3>());
  file.contacts = decoder.contacts(file.loads[0], 12, [&] { return direction(decoder); });
  for (Contact<3>& c : file.contacts)
    if (c.friction > 0 && decoder.one_in(3)) c.torsion = decoder.positive();
  if (decoder.one_in(4)) file.safety = 1 + decoder.positive();
  if (decoder.one_in(4)) file.tilt = Tilt{direction(decoder), std::abs(decoder.angle()) / 2};
  return file;
}

class Judge {
 public:
  Judge(const SpatialFile& file, bool moderate) : file_(file), moderate_(moderate) {}

  void demand(bool right, const std::string& what) const {
    if (right) return;
    std::fprintf(stderr, "WRONG: %s\n%s\n", what.c_str(), grasp_document(file_).c_str());
    std::abort();
  }

  /// The greatest effort [N^2]; infinite where weights are too large for squares.
  double squared(double force_cap) const {
    double heaviest = 0;
    for (const Load<3>& object : file_.loads) heaviest = std::max(heaviest, object.weight);
    return force_cap * heaviest * (force_cap * heaviest);
  }

  void judge(const Posture<3>& posture, double force_cap) const {
    const Hold<3>& hold = posture.hold();
    demand(std::abs(posture.up.norm() - 1) <= 1e-9, "up is a unit vector");
    demand(hold.dual.allFinite(), "hold: dual is finite");
    demand(std::isfinite(hold.lower_bound), "hold: lower_bound is finite");
    if (!hold.holdable) {
      demand(hold.forces.empty() && hold.effort == 0, "hold: the unholdable has no forces");
      return;
    }
    demand(hold.effort >= 0 && hold.effort <= squared(force_cap) * (1 + 1e-6),
           "hold: effort below the cap");
    demand(hold.forces.size() == file_.contacts.size(), "hold: every contact has a force");
    demand(hold.residual <= 1e-6, "hold: the forces balance");
    for (const ContactForce<3>& force : hold.forces) {
      demand(force.normal >= 0 && std::isfinite(force.normal), "hold: normal force is finite");
      demand(force.friction_used >= 0 && force.friction_used <= 1, "hold: friction_used");
    }
  }

  /// The document, and the answer itself.
  void judge(const Grasp<3>& grasp, const auto& answer) const {
    demand(nlohmann::json::accept(document(grasp, answer)), "the document is JSON");
    if (!moderate_) return;
    const std::string refuted = refutations_text(verify::verify(grasp, answer));
    demand(refuted.empty(), refuted);
  }

 private:
  const SpatialFile& file_;
  bool moderate_;
};

}  // namespace
}  // namespace poise

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace poise;
  Decoder decoder(data, size);
  const SpatialFile file = question(decoder);
  std::optional<Grasp<3>> grasp;
  try {
    grasp.emplace(file.grasp());
  } catch (const InvalidGrasp&) {
    return 0;
  }
  const Judge judge(file, !decoder.extreme());
  for (int k = 0; k < 2; ++k) {
    const HoldAnswer<3> held{.posture = posture_at(*grasp, direction(decoder))};
    judge.judge(held.posture, held.settings.force_cap);
    judge.judge(*grasp, held);
  }
  SpatialSettings settings;
  settings.max_holds = 100;
  settings.starts = decoder.one_in(4) ? 8 : 0;
  settings.tilt = file.tilt;
  BestAnswer<3> answer{settings, best_posture(*grasp, settings)};
  answer.orientation = orientation_of(direction(decoder));
  judge.demand(
      std::isfinite(answer.best.lower_bound) || !std::isfinite(judge.squared(settings.force_cap)),
      "best: lower_bound is finite");
  for (const Minimum<3>& minimum : answer.best.minima) judge.judge(minimum, settings.force_cap);
  judge.judge(*grasp, answer);
  return 0;
}
