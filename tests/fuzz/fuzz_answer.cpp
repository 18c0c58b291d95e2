// Whole answers for grasps decoded from bytes, extreme and degenerate ones on purpose: what is
// asserted here holds always.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "decoder.hpp"
#include "files/grasp_writer.hpp"
#include "verify/verify.hpp"

namespace poise {
namespace {

/// What is asked.
struct Task {
  PlanarFile file{};
  CurveSettings settings{};
};

Task task(Decoder& decoder) {
  Task task;
  task.file.loads = {decoder.object<2>()};
  if (decoder.coin()) task.file.safety = 1 + decoder.positive();
  task.settings.domain = decoder.coin() ? Domain::all : Domain::pinching_up;
  if (decoder.coin()) task.settings.force_cap = std::min(1e9, 10 * decoder.positive());
  task.file.contacts =
      decoder.contacts(task.file.loads[0], 12, [&] { return up_at(decoder.angle()); });
  return task;
}

class Judge {
 public:
  /// @param moderate  whether no number is extreme: then the verifier confirms holds, too
  Judge(const Task& task, const Grasp<2>& grasp, bool moderate)
      : task_(task), grasp_(grasp), moderate_(moderate) {}

  void demand(bool right, const char* what, double at) const {
    if (right) return;
    std::fprintf(stderr, "WRONG: %s, at %.17g\n%s\ndomain: %s, force_cap: %.17g\n", what, at,
                 grasp_document(task_.file).c_str(),
                 task_.settings.domain == Domain::all ? "all" : "pinching-up",
                 task_.settings.force_cap);
    std::abort();
  }

  void judge(const Hold<2>& hold, double at) const {
    const double cap = task_.settings.force_cap * grasp_.size();
    demand(hold.dual.allFinite(), "hold: dual is finite", at);
    demand(std::isfinite(hold.lower_bound), "hold: lower_bound is finite", at);
    demand(std::isfinite(hold.effort) && hold.effort >= 0, "hold: effort is finite", at);
    if (!hold.holdable) {
      demand(hold.forces.empty() && hold.effort == 0, "hold: the unholdable has no forces", at);
      demand(
          !hold.proven || hold.lower_bound >= cap * cap * (1 - 1e-9) || !std::isfinite(cap * cap),
          "hold: what is called proven is", at);
      demand(!reason(grasp_, hold).empty(), "hold: the unholdable has a reason", at);
      return;
    }
    demand(hold.forces.size() == grasp_.contacts().size(), "hold: every contact has a force", at);
    demand(hold.residual <= 1e-6, "hold: the forces balance", at);
    demand(hold.effort <= cap * cap * (1 + 1e-6), "hold: the effort is below the cap", at);
    for (const ContactForce<2>& force : hold.forces) {
      demand(force.normal >= 0 && std::isfinite(force.normal), "hold: normal force is finite", at);
      demand(std::isfinite(force.tangential), "hold: tangential force is finite", at);
      demand(force.friction_used >= 0 && force.friction_used <= 1, "hold: friction_used", at);
    }
  }

  void judge(const PostureCurve& curve) const {
    const Interval& domain = curve.domain;
    demand(domain.from >= -pi && domain.from <= domain.to && domain.to <= domain.from + 2 * pi,
           "curve: domain", domain.from);
    double covered = 0, last = -infinity;
    for (const Arc& arc : curve.arcs) {
      demand(arc.from <= arc.to, "curve: an arc begins before it ends", arc.from);
      demand(arc.from >= last - 1e-7, "curve: arcs are in order", arc.from);
      demand(arc.first_state + grasp_.contacts().size() <= curve.states.size(), "curve: states",
             arc.from);
      demand(std::isfinite(arc.value(arc.from)) && std::isfinite(arc.value(arc.to)),
             "curve: V is finite", arc.from);
      for (const Harmonic1& y : arc.y)
        demand(std::isfinite(y(arc.from)), "curve: y is finite", arc.from);
      covered += arc.to - arc.from;
      last = arc.to;
    }
    for (const UnholdableArc& gap : curve.unholdable_arcs) {
      demand(gap.from <= gap.to, "curve: an unholdable arc begins before it ends", gap.from);
      demand(gap.y.allFinite(), "curve: the proof is finite", gap.from);
      covered += gap.to - gap.from;
    }
    for (const Interval& part : curve.undecided) covered += part.to - part.from;
    demand(std::abs(covered - (domain.to - domain.from)) <= 1e-5,
           "curve: arcs, unholdable arcs and the undecided cover the domain", covered);
    for (const Interval& part : curve.holdable)
      demand(part.from >= -pi && part.from < pi && part.from <= part.to &&
                 part.to <= part.from + 2 * pi,
             "curve: a holdable interval", part.from);
    demand(curve.optima.empty() == curve.arcs.empty(), "curve: optima where it holds", 0);
    for (const Optimum& optimum : curve.optima) {
      demand(std::isfinite(optimum.value), "curve: the effort of an optimum", optimum.angle);
      demand(optimum.from <= optimum.to, "curve: the stretch of an optimum", optimum.angle);
      demand(optimum.angle > -pi && optimum.angle <= pi, "curve: the angle of an optimum",
             optimum.angle);
      const double middle = (domain.from + domain.to) / 2, half = (domain.to - domain.from) / 2;
      demand(std::abs(std::remainder(optimum.angle - middle, 2 * pi)) <= half + 1e-9,
             "curve: an optimum is in the domain", optimum.angle);
    }
  }

  void judge(const Best<2>& best) const {
    judge(best.proof.curve);
    demand(best.holdable() == !best.proof.curve.arcs.empty(), "best: holdable", 0);
    demand(std::isfinite(best.lower_bound), "best: lower_bound is finite", 0);
    for (const Minimum<2>& minimum : best.minima) judge(minimum.hold(), minimum.optimum.angle);
    if (best.holdable())
      demand(best.lower_bound <= best.minima.front().optimum.value * (1 + 1e-3),
             "best: lower_bound is one", best.lower_bound);
  }

  void judge(const HoldAnswer<2>& answer) const {
    judge(answer.posture.hold(), angle_of(answer.posture.up));
    if (!moderate_) return;
    const std::string refuted = refutations_text(verify::verify(grasp_, answer));
    demand(refuted.empty(), refuted.c_str(), angle_of(answer.posture.up));
  }

  void judge(const std::string& document) const {
    demand(nlohmann::json::accept(document), "the document is JSON", 0);
  }

 private:
  const Task& task_;
  const Grasp<2>& grasp_;
  bool moderate_;
};

void ask(const Task& task, const Grasp<2>& grasp, Decoder& decoder) {
  const Judge judge(task, grasp, !decoder.extreme());
  const HoldSettings settings{task.settings.force_cap};
  const Load<2>& load = grasp.loads().front();
  Twist<2> y = Twist<2>::Zero();
  for (int k = 0; k < 4; ++k) {
    const Vector<2> up = up_at(decoder.angle());
    const HoldAnswer<2> cold{.settings = settings, .posture = posture_at<2>(grasp, up, settings)};
    judge.judge(cold);
    if (k == 0) judge.judge(document(grasp, cold));
    judge.judge(hold(grasp, load.at(up), load.weight, y, settings), angle_of(up));
    y = cold.posture.hold().dual;
  }
  CurveAnswer curve{task.settings, posture_curve(grasp, task.settings)};
  judge.judge(curve.curve);
  for (const Optimum& optimum : curve.curve.optima)
    curve.optima.push_back(minimum_at(grasp, optimum, task.settings));
  judge.judge(document(grasp, curve));
  const BestAnswer<2> best{task.settings, best_posture(grasp, task.settings)};
  judge.judge(best.best);
  judge.judge(document(grasp, best));
  judge.judge(document(task.file, grasp, CheckAnswer<2>{force_closure(grasp), {}}));
}

}  // namespace
}  // namespace poise

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  poise::Decoder decoder(data, size);
  const poise::Task task = poise::task(decoder);
  std::optional<poise::Grasp<2>> grasp;
  try {
    grasp.emplace(task.file.grasp());
  } catch (const poise::InvalidGrasp&) {
    return 0;
  }
  poise::ask(task, *grasp, decoder);
  return 0;
}
