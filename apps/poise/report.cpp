#include "report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "files/result.hpp"

namespace poise {
namespace {

constexpr double pi = 3.14159265358979323846;

std::string title(const GraspFile& file, const Style& style) {
  return file.name.empty() ? "" : style.bold(file.name) + "\n\n";
}

std::string heading(const std::string& text, const Style& style) {
  return "\n" + style.bold(text) + "\n";
}

/// The finger that presses hardest, as "finger left".
std::string strongest(const Grasp<2>& grasp, const Hold<2>& hold) {
  const auto fingers = finger_forces(grasp, hold);
  const auto most =
      std::max_element(fingers.begin(), fingers.end(),
                       [](const auto& a, const auto& b) { return a.normal < b.normal; });
  if (most == fingers.end()) return "one finger";
  return "finger " + grasp.fingers()[static_cast<std::size_t>(most - fingers.begin())];
}

std::string range_text(const Interval& interval) {
  if (interval.from == interval.to) return "only at " + degrees_text(interval.from);
  if (interval.to - interval.from >= 2 * pi) return "in every posture";
  return "from " + degrees_text(interval.from) + " to " + degrees_text(interval.to);
}

std::string ranges_text(const std::vector<Interval>& intervals) {
  if (intervals.empty()) return "in no posture";
  std::string text;
  for (const Interval& interval : intervals)
    text += (text.empty() ? "" : ", ") + range_text(interval);
  return text;
}

/// The posture of an optimum, and the stretch that is as good.
std::string posture_text(const Optimum& optimum) {
  const std::string angle = degrees_text(optimum.angle);
  if (optimum.from == optimum.to) return angle;
  const std::string stretch = range_text({optimum.from, optimum.to});
  return angle + " (the same " + stretch + ")";
}

/// Forces by contact, and by finger where a finger has several contacts.
std::string forces_table(const Grasp<2>& grasp, const Hold<2>& hold, const Style& style) {
  const auto fingers = finger_forces(grasp, hold);
  const int decimals = decimals_for(grip_force(grasp, hold));
  Table table(
      {"<finger", "contact", "normal [N]", "tangential [N]", "friction used", "<state", "<limit"});
  for (std::size_t k = 0; k < fingers.size(); ++k) {
    std::size_t contacts = 0;
    for (std::size_t i = 0; i < hold.forces.size(); ++i) {
      if (grasp.finger_of(i) != k) continue;
      const ContactForce<2>& force = hold.forces[i];
      const bool loaded = force.state != ContactState::unloaded;
      table.add({contacts++ == 0 ? grasp.fingers()[k] : "", std::to_string(i),
                 fixed(force.normal, decimals), fixed(force.tangential, decimals),
                 loaded ? fixed(100 * force.friction_used, 1) + " %" : "", to_string(force.state),
                 force.limit == ForceLimit::none  ? ""
                 : force.limit == ForceLimit::min ? "at min_normal"
                                                  : "at max_normal"});
    }
    if (contacts > 1) table.add({"", "together", fixed(fingers[k].normal, decimals)});
  }
  return table.text(style);
}

std::string optima_table(const Grasp<2>& grasp, const std::vector<PlanarPosture>& optima,
                         bool with_type, const Style& style) {
  // Four digits of the least number in a column.
  double grip = 0, effort = 0;
  for (const PlanarPosture& posture : optima) {
    const double force = grip_force(grasp, posture.hold);
    grip = grip == 0 ? force : std::min(grip, force);
    effort = effort == 0 ? posture.optimum.effort : std::min(effort, posture.optimum.effort);
  }
  std::vector<std::string> headings{"posture",     "grip force [N]", "force norm [N]",
                                    "effort [N²]", "<manner",        "<kind"};
  if (with_type) headings.emplace_back("<type");
  Table table(headings);
  for (const PlanarPosture& posture : optima) {
    const Optimum& optimum = posture.optimum;
    std::vector<std::string> row{posture_text(optimum),
                                 fixed(grip_force(grasp, posture.hold), decimals_for(grip)),
                                 fixed(std::sqrt(optimum.effort), decimals_for(std::sqrt(effort))),
                                 fixed(optimum.effort, decimals_for(effort)),
                                 to_string(posture.manner),
                                 to_string(optimum.kind)};
    if (with_type) row.emplace_back(optimum.maximum ? "maximum" : "minimum");
    table.add(std::move(row));
  }
  return table.text(style);
}

/// "turn by 30.00° counter-clockwise"
std::string turn_text(double from, double to) {
  const double turn = std::remainder(to - from, 2 * pi);
  const std::string size = degrees_text(std::abs(turn));
  if (size == degrees_text(0)) return "stay";
  return "turn by " + size + (turn < 0 ? " clockwise" : " counter-clockwise");
}

/// One line of the summary: which posture, its angle, the forces, and how to get there.
void add_posture(Table& table, const std::string& which, const Grasp<2>& grasp, double theta,
                 const Hold<2>& hold, const std::string& how) {
  table.add({which, degrees_text(theta),
             hold.holdable ? "grip force " + newtons(grip_force(grasp, hold)) : "cannot be held",
             hold.holdable ? to_string(manner(grasp, up_at(theta), hold)) : "", how});
}

std::string why_pinching_costs(const Grasp<2>& grasp, const PlanarPosture& best,
                               const PlanarPosture& pinched) {
  const double factor = pinched.optimum.effort / best.optimum.effort;
  const std::string cost = fmt::format(
      "Pinched it costs {} times the force norm ({} times the effort): ", plain(std::sqrt(factor)),
      plain(factor));
  const std::string squeeze =
      ", whereas pinched the fingers have to squeeze, so that friction carries the weight.";
  if (best.manner == Manner::resting)
    return cost + "at the best posture it rests on " + strongest(grasp, best.hold) + squeeze;
  if (best.manner == Manner::cradled)
    return cost + "at the best posture it lies in the fork of the fingers" + squeeze;
  return cost + "the best posture is at an end of those in which it can be held.";
}

std::string scope(const CurveSettings& settings) {
  return settings.domain == Domain::all ? "" : " outside the fork of the fingers";
}

/// What the answer does not know, if anything.
std::string doubt(const PostureCurve& curve) {
  if (curve.undecided.empty()) return {};
  double sum = 0;
  for (const Interval& part : curve.undecided) sum += part.to - part.from;
  return "\n" + wrapped(fmt::format(
                    "Not all is proven: rounding left {:.2g}° of postures undecided, near {}.",
                    degrees(sum), degrees_text(curve.undecided.front().from)));
}

/// Why nothing in the domain can be held, in words.
std::string nowhere(const Grasp<2>& grasp, const PostureCurve& curve,
                    const CurveSettings& settings) {
  if (!curve.undecided.empty())
    return "Found no posture" + scope(settings) + " in which it can be held.\n" + doubt(curve);
  const Interval domain = domain_interval(grasp, settings.domain);
  const double middle = (domain.from + domain.to) / 2;
  const Hold<2> there = hold(grasp, up_at(middle), {.force_cap = settings.force_cap});
  std::string text = "Cannot be held in any posture" + scope(settings) + ".\n";
  if (!there.holdable)
    text += wrapped("At " + degrees_text(middle) + ": " + reason(grasp, there) + ".");
  return text;
}

/// Lengths in the unit that makes them easy to read.
struct Lengths {
  explicit Lengths(const Grasp<2>& grasp)
      : per_metre(grasp.radius() >= 1 ? 1 : 1000),
        decimals(decimals_for(grasp.radius() * per_metre)),
        unit(grasp.radius() >= 1 ? "m" : "mm") {}
  std::string text(double length) const { return fixed(per_metre * length, decimals); }
  std::string text(const Vector<2>& v) const {
    return "(" + text(v.x()) + ", " + text(v.y()) + ")";
  }
  double per_metre;
  int decimals;
  std::string unit;
};

std::string shape_text(const Shape& shape, const Lengths& lengths) {
  if (const auto* disk = std::get_if<Disk>(&shape))
    return "disk, radius " + lengths.text(disk->radius) + " " + lengths.unit;
  if (const auto* ellipse = std::get_if<Ellipse>(&shape))
    return "ellipse, radii " + lengths.text(ellipse->radii.x()) + " and " +
           lengths.text(ellipse->radii.y()) + " " + lengths.unit;
  return fmt::format("polygon of {} vertices", std::get<Polygon>(shape).vertices.size());
}

std::string limits_text(const Contact<2>& contact) {
  const bool capped = std::isfinite(contact.max_normal);
  if (contact.min_normal == 0) return capped ? "at most " + plain(contact.max_normal) : "";
  return plain(contact.min_normal) + (capped ? " to " + plain(contact.max_normal) : " or more");
}

}  // namespace

std::string check_report(const GraspFile& file, const Grasp<2>& grasp, const Style& style) {
  const Lengths lengths(grasp);
  const Interval cradled = cradled_wedge(grasp);
  Table facts({"<", "<"});
  facts.add({"weight", newtons(grasp.object().weight)});
  facts.add({"centre of mass", lengths.text(grasp.object().com) + " " + lengths.unit});
  if (file.shape) facts.add({"shape", shape_text(*file.shape, lengths)});
  facts.add({"held now", file.angle ? "turned to " + degrees_text(*file.angle) : "not given"});
  if (file.safety != 1)
    facts.add({"safety", "friction divided by " + plain(file.safety) + " (below: after that)"});
  facts.add({"fingers",
             fmt::format("{}, with {} contacts", grasp.fingers().size(), grasp.contacts().size())});
  facts.add({"force closure", force_closure(grasp) ? "yes, any load can be balanced"
                                                   : "no, not every load can be balanced"});
  facts.add({"cradled", cradled.from < cradled.to
                            ? range_text(cradled) + ", in the fork of the fingers"
                            : "nowhere"});
  std::string text = title(file, style) + facts.text(style);

  Table table({"<finger", "contact", fmt::format("position [{}]", lengths.unit), "inward normal",
               "friction", "cone", "<normal force [N]"});
  for (std::size_t i = 0; i < grasp.contacts().size(); ++i) {
    const Contact<2>& contact = grasp.contacts()[i];
    table.add({contact.finger, std::to_string(i), lengths.text(contact.position),
               "(" + fixed(contact.normal.x(), 4) + ", " + fixed(contact.normal.y(), 4) + ")",
               plain(contact.friction), "± " + fixed(degrees(std::atan(contact.friction)), 1) + "°",
               limits_text(contact)});
  }
  text += heading("Contacts", style) + table.text(style);

  text += file.warnings.empty() ? "\nNo warnings.\n"
                                : heading(fmt::format("Warnings: {}", file.warnings.size()), style);
  for (const std::string& warning : file.warnings) text += "  " + warning + "\n";
  return text;
}

std::string hold_report(const GraspFile& file, const Grasp<2>& grasp, double theta,
                        const Hold<2>& hold, const Style& style) {
  const std::string at = "At " + degrees_text(theta);
  if (!hold.holdable)
    return title(file, style) + wrapped(at + " it cannot be held: " + reason(grasp, hold) + ".");
  return title(file, style) +
         fmt::format("{}: grip force {}, {}\n", at, style.bold(newtons(grip_force(grasp, hold))),
                     to_string(manner(grasp, up_at(theta), hold))) +
         heading("Forces", style) + forces_table(grasp, hold, style) +
         fmt::format("\nForce norm {}, effort {} N².\n", newtons(std::sqrt(hold.effort)),
                     plain(hold.effort));
}

std::string best_report(const GraspFile& file, const Grasp<2>& grasp, const BestPosture& best,
                        const CurveSettings& settings, const Style& style) {
  std::string text = title(file, style);
  if (!best.holdable()) return text + nowhere(grasp, best.curve, settings);

  const PlanarPosture& lowest = best.best();
  const PlanarPosture* const pinched = best.best_pinched();
  const bool differ = pinched && pinched != &lowest;
  const double from = file.angle.value_or(0);
  Table summary({"<", "", "", "<", "<"});
  if (file.angle)
    add_posture(summary, "now", grasp, from,
                hold(grasp, up_at(from), {.force_cap = settings.force_cap}), "");
  add_posture(summary, "best", grasp, lowest.optimum.angle, lowest.hold,
              turn_text(from, lowest.optimum.angle));
  if (differ)
    add_posture(summary, "best pinched", grasp, pinched->optimum.angle, pinched->hold,
                turn_text(from, pinched->optimum.angle));
  text += summary.text(style);
  if (differ) text += "\n" + wrapped(why_pinching_costs(grasp, lowest, *pinched));
  if (!pinched) text += "\nThere is no pinched minimum" + scope(settings) + ".\n";

  text += heading("Minima, lowest first", style) + optima_table(grasp, best.minima, false, style);
  text += heading("Forces at " + degrees_text(lowest.optimum.angle) + ", the best", style) +
          forces_table(grasp, lowest.hold, style);
  if (differ)
    text +=
        heading("Forces at " + degrees_text(pinched->optimum.angle) + ", the best pinched", style) +
        forces_table(grasp, pinched->hold, style);
  return text + "\nHoldable " + ranges_text(best.curve.holdable) + scope(settings) + ".\n" +
         doubt(best.curve);
}

std::string curve_report(const GraspFile& file, const Grasp<2>& grasp, const PostureCurve& curve,
                         const CurveSettings& settings, const Style& style) {
  std::string text = title(file, style);
  if (curve.holdable.empty()) return text + nowhere(grasp, curve, settings);
  std::vector<PlanarPosture> optima;
  for (const Optimum& optimum : curve.optima)
    optima.push_back(posture_at(grasp, optimum, settings));
  text += "Holdable " + ranges_text(curve.holdable) + scope(settings) + ".\n" + doubt(curve);
  text += heading("Minima, lowest first, then maxima, highest first", style) +
          optima_table(grasp, optima, true, style);

  // Along an arc nothing changes but the size of the forces.
  constexpr std::size_t most_columns = 8;
  const std::size_t contacts = grasp.contacts().size();
  std::vector<std::string> headings{"from", "to", "force norm [N]", "to [N]"};
  if (contacts <= most_columns)
    for (std::size_t i = 0; i < contacts; ++i) headings.push_back("<" + grasp.contacts()[i].finger);
  Table table(headings);
  double largest = 0;
  for (const Arc& arc : curve.arcs) largest = std::max({largest, arc.V(arc.from), arc.V(arc.to)});
  const int decimals = decimals_for(std::sqrt(largest));
  const auto norm = [](const Arc& arc, double theta) {
    return std::sqrt(std::max(0.0, arc.V(theta)));
  };
  for (const Arc& arc : curve.arcs) {
    std::vector<std::string> row{degrees_text(arc.from), degrees_text(arc.to),
                                 fixed(norm(arc, arc.from), decimals),
                                 fixed(norm(arc, arc.to), decimals)};
    if (contacts <= most_columns)
      for (std::size_t i = 0; i < contacts; ++i) {
        const ArcState& state = curve.states[arc.first_state + i];
        row.push_back(
            std::string(to_string(state.state)) +
            (state.limit == ForceLimit::none ? "" : std::string(" at ") + to_string(state.limit)));
      }
    table.add(std::move(row));
  }
  return text + heading("Arcs: what each contact does", style) + table.text(style);
}

}  // namespace poise
