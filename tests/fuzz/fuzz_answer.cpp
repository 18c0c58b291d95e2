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
#include "files/result.hpp"
#include "poise/best_posture.hpp"

namespace poise {
namespace {

/// What a posture is asked for; printed where an answer is wrong.
struct Question {
  Load<2> object{};
  std::vector<Contact<2>> contacts{};
  double safety{1};
  CurveSettings settings{};
};

Question question(Decoder& decoder) {
  Question q;
  q.object = decoder.object<2>();
  if (decoder.coin()) q.safety = 1 + decoder.positive();
  q.settings.domain = decoder.coin() ? Domain::all : Domain::pinched;
  if (decoder.coin()) q.settings.force_cap = std::min(1e9, 10 * decoder.positive());
  q.contacts = decoder.contacts(q.object, 12, [&] { return up_at(decoder.angle()); });
  return q;
}

/// The question as C++, to be pasted into a test.
void print(const Question& q) {
  std::fprintf(stderr, "Grasp<2> grasp({.weight = %.17g, .com = {%.17g, %.17g}}, {\n",
               q.object.weight, q.object.com.x(), q.object.com.y());
  for (const Contact<2>& c : q.contacts)
    std::fprintf(
        stderr,
        "  {.position = {%.17g, %.17g}, .normal = {%.17g, %.17g}, .friction = %.17g,\n"
        "   .min_normal = %.17g, .max_normal = %.17g, .share = %.17g, .finger = \"%s\"},\n",
        c.position.x(), c.position.y(), c.normal.x(), c.normal.y(), c.friction, c.min_normal,
        c.max_normal, c.share, c.finger.c_str());
  std::fprintf(stderr, "}, %.17g);\nCurveSettings settings{Domain::%s, %.17g};\n", q.safety,
               q.settings.domain == Domain::all ? "all" : "pinched", q.settings.force_cap);
}

class Judge {
 public:
  Judge(const Question& question, const Grasp<2>& grasp) : question_(question), grasp_(grasp) {}

  void demand(bool right, const char* what, double at) const {
    if (right) return;
    std::fprintf(stderr, "WRONG: %s, at %.17g\n", what, at);
    print(question_);
    std::abort();
  }

  void judge(const Hold<2>& hold, double at) const {
    const double cap = question_.settings.force_cap * grasp_.weight();
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
      demand(std::isfinite(arc.V(arc.from)) && std::isfinite(arc.V(arc.to)), "curve: V is finite",
             arc.from);
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
      demand(std::isfinite(optimum.effort), "curve: the effort of an optimum", optimum.angle);
      demand(optimum.from <= optimum.to, "curve: the stretch of an optimum", optimum.angle);
      demand(optimum.angle > -pi && optimum.angle <= pi, "curve: the angle of an optimum",
             optimum.angle);
      const double middle = (domain.from + domain.to) / 2, half = (domain.to - domain.from) / 2;
      demand(std::abs(std::remainder(optimum.angle - middle, 2 * pi)) <= half + 1e-9,
             "curve: an optimum is in the domain", optimum.angle);
    }
  }

  void judge(const BestPosture& best) const {
    judge(best.curve);
    demand(best.holdable() == !best.curve.arcs.empty(), "best: holdable", 0);
    demand(std::isfinite(best.lower_bound), "best: lower_bound is finite", 0);
    for (const Minimum<2>& minimum : best.minima) judge(minimum.hold, minimum.optimum.angle);
    if (best.holdable())
      demand(best.lower_bound <= best.minima.front().optimum.effort * (1 + 1e-3),
             "best: lower_bound is one", best.lower_bound);
  }

  void judge(const std::string& document) const {
    demand(nlohmann::json::accept(document), "the document is JSON", 0);
  }

 private:
  const Question& question_;
  const Grasp<2>& grasp_;
};

void ask(const Question& q, const Grasp<2>& grasp, Decoder& decoder) {
  const Judge judge(q, grasp);
  const HoldSettings settings{q.settings.force_cap};
  Twist<2> y = Twist<2>::Zero();
  for (int k = 0; k < 4; ++k) {
    const double theta = decoder.angle();
    const Hold<2> cold = hold(grasp, up_at(theta), settings);
    judge.judge(cold, theta);
    if (k == 0) judge.judge(hold_document(grasp, theta, cold, settings));
    const Hold<2> warm = hold(grasp, grasp.loads().front().at(up_at(theta)), y, settings);
    judge.judge(warm, theta);
    y = cold.dual;
  }
  const PostureCurve curve = posture_curve(grasp, q.settings);
  judge.judge(curve);
  judge.judge(curve_document(grasp, curve, q.settings));
  const Best<2> best = best_posture(grasp, q.settings);
  judge.judge(best);
  judge.judge(best_document(grasp, best, q.settings));
  PlanarFile file;
  file.object = q.object;
  file.contacts = q.contacts;
  judge.judge(check_document(file, grasp));
}

}  // namespace
}  // namespace poise

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  poise::Decoder decoder(data, size);
  const poise::Question question = poise::question(decoder);
  std::optional<poise::Grasp<2>> grasp;
  try {
    grasp.emplace(question.object, question.contacts, question.safety);
  } catch (const poise::InvalidGrasp&) {
    return 0;
  }
  poise::ask(question, *grasp, decoder);
  return 0;
}
