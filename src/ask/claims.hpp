// What JSON documents claim, as values: docs/command-line.md. `fields` lists the keys of each part,
// once for who writes and who reads. An optional is null where there is none; those that are
// visited by `maybe` are left out then. What is visited by `degrees` is in radians here.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "poise/best_posture.hpp"
#include "poise/capacity.hpp"
#include "poise/turn.hpp"

namespace poise {

/// Of an optimum of a curve.
enum class Extremum { min, max };

/// The words for the values of an enumeration, in their order.
using Words = std::vector<std::string_view>;
inline Words words_of(ContactState) { return {"unloaded", "sticking", "slipping"}; }
inline Words words_of(ForceLimit) { return {"none", "min", "max"}; }
inline Words words_of(Manner) { return {"resting", "cradled", "pinched"}; }
inline Words words_of(Kind) { return {"boundary", "kink", "smooth"}; }
inline Words words_of(Status) { return {"optimal", "gap", "unholdable"}; }
inline Words words_of(Domain) { return {"all", "pinching-up"}; }
inline Words words_of(Objective) { return {"grip", "effort"}; }
inline Words words_of(Extremum) { return {"min", "max"}; }

// Parts that are told as the library has them.

void fields(Harmonic2& V, auto& visit) {
  visit("c0", V.c0, "cos1", V.cos1, "sin1", V.sin1, "cos2", V.cos2, "sin2", V.sin2);
}
void fields(Harmonic1& F, auto& visit) { visit("c0", F.c0, "cos1", F.cos1, "sin1", F.sin1); }
void fields(ArcForce& force, auto& visit) {
  visit("normal", force.normal, "tangential", force.tangential);
}
void fields(ArcState& arc, auto& visit) { visit("state", arc.state, "limit", arc.limit); }
void fields(Tilt& tilt, auto& visit) {
  visit("from", tilt.from);
  visit.degrees("max_deg", tilt.most);
}
void fields(Pad& pad, auto& visit) {
  visit("points", pad.points, "shares", pad.shares, "axis", pad.axis, "reach", pad.reach);
}
void fields(Cut& cut, auto& visit) {
  visit.maybe("n", cut.n);
  if (cut.n) return;
  visit("y", cut.y, "load", cut.load);
  visit.maybe("rates", cut.rates);
}

/// The fields of a load beside its name, as a check tells them: calls visit(name, pointer to
/// member).
template <int Dim, class Visit>
void for_each_load_field(const Visit& visit) {
  visit("weight", &Load<Dim>::weight);
  visit("com", &Load<Dim>::com);
  visit("lift", &Load<Dim>::lift);
  visit("acceleration", &Load<Dim>::acceleration);
  visit("fixed", &Load<Dim>::fixed);
}

/// What one contact does.
template <int Dim>
struct ContactClaim {
  std::string finger;
  double friction_used{0}, normal_force{0};
  double tangential_force{0};                     ///< in space its size
  std::optional<double> torsion_moment{};         ///< of a soft finger
  Vector<Dim> force;                              ///< object frame
  std::optional<Vector<3>> center_of_pressure{};  ///< of a pad, object frame
  /// Of a pad: the tangential force of each of its points, object frame.
  std::optional<std::vector<Vector<3>>> point_forces{};
  ContactState state{};
  ForceLimit limit{};

  void fields(auto& visit) {
    visit("finger", finger, "friction_used", friction_used, "normal_force", normal_force);
    visit("tangential_force", tangential_force);
    visit.maybe("torsion_moment", torsion_moment);
    visit("force", force);
    visit.maybe("center_of_pressure", center_of_pressure, "point_forces", point_forces);
    visit("state", state, "limit", limit);
  }
};

template <int Dim>
struct FingerClaim {
  std::string finger;
  double normal_force{0};
  std::optional<double> pressing_force{};  ///< null without a closing direction
  Vector<Dim> force;

  void fields(auto& visit) {
    visit("finger", finger, "normal_force", normal_force, "pressing_force", pressing_force);
    visit("force", force);
  }
};

struct DriveClaim {
  std::string name;
  double effort{0};
  std::optional<double> max{}, part_of_max{};  ///< null where nothing limits it

  void fields(auto& visit) {
    visit("name", name, "effort", effort, "max", max, "part_of_max", part_of_max);
  }
};

/// A hold in a posture: of the load that decides, and then those of the others.
template <int Dim>
struct HoldClaim {
  bool holdable{false};
  Vector<Dim> up;
  double angle_deg{0};  ///< in the plane
  // Where there are several loads.
  std::optional<std::size_t> load{};  ///< that decides
  /// What each needs, in the objective; null: cannot be held.
  std::optional<std::vector<std::optional<double>>> load_grips{}, load_efforts{};
  std::vector<std::optional<HoldClaim>> load_holds;  ///< null: this one, or cannot be held
  Objective objective{Objective::effort};
  Twist<Dim> dual;                             ///< told as `y` for the grip
  std::optional<std::vector<double>> rates{};  ///< of the drives, where they say something
  double lower_bound{0};
  std::optional<bool> proven{};  ///< told where it is false, of what is not holdable
  std::string reason{};          ///< where unholdable; then nothing of what follows
  double effort{0}, force_norm{0}, residual{0};
  Manner manner{};
  bool all_loaded{false};
  std::optional<double> grip{};  ///< null where fingers have no closing direction
  std::vector<DriveClaim> drives{};
  std::vector<FingerClaim<Dim>> fingers{};
  std::vector<ContactClaim<Dim>> contacts{};

  void fields(auto& visit) {
    visit("holdable", holdable, "up", up);
    if constexpr (Dim == 2) visit("angle_deg", angle_deg);
    visit.maybe("load", load);
    visit.maybe("load_grips", load_grips, "load_efforts", load_efforts);
    if (load) visit("load_holds", load_holds);
    visit("objective", objective);
    visit(objective == Objective::grip ? "y" : "dual", dual);
    visit.maybe("rates", rates);
    visit("lower_bound", lower_bound);
    visit.maybe("proven", proven);
    if (!holdable) return visit("reason", reason);
    visit("effort", effort, "force_norm", force_norm, "residual", residual, "manner", manner);
    visit("all_loaded", all_loaded, "grip", grip, "drives", drives);
    visit("fingers", fingers, "contacts", contacts);
  }
};

/// Of the posture curve.
struct OptimumClaim : HoldClaim<2> {
  Kind kind{};
  std::optional<Extremum> type{};              ///< where there are minima and maxima
  std::optional<double> from_deg{}, to_deg{};  ///< the stretch of equal V, where there is one
  /// Null where the edges are parallel; none where they were not asked for.
  std::optional<std::optional<Vector<2>>> edges_meet{};

  void fields(auto& visit) {
    visit("kind", kind);
    visit.maybe("type", type, "from_deg", from_deg, "to_deg", to_deg);
    HoldClaim<2>::fields(visit);
    visit.maybe("edges_meet", edges_meet);
  }
};

/// How a minimum of the effort over the postures is claimed.
template <int Dim>
using MinimumClaim = std::conditional_t<Dim == 2, OptimumClaim, HoldClaim<3>>;

/// The dual on an arc: c0 + cos1 cos(theta) + sin1 sin(theta).
struct ArcDual {
  Twist<2> c0, cos1, sin1;

  void fields(auto& visit) { visit("c0", c0, "cos1", cos1, "sin1", sin1); }
};

struct ArcClaim {
  double from{0}, to{0};              ///< [rad]
  std::optional<Harmonic1> F{};       ///< of grip; then y and rates prove it all along
  Harmonic2 V{};                      ///< of effort
  ArcDual y{};                        ///< of grip c0 alone
  std::vector<double> rates{};        ///< of grip
  std::vector<ArcForce> forces{};     ///< of grip, one for each contact
  std::vector<ArcState> states{};     ///< one for each contact
  std::optional<std::size_t> load{};  ///< that needs most, where there are several

  void fields(auto& visit) {
    visit.degrees("from_deg", from, "to_deg", to);
    visit.maybe("load", load);
    visit.maybe("F", F);
    if (F)
      visit("y", y.c0, "rates", rates, "forces", forces);
    else
      visit("V", V, "y", y);
    visit("states", states);
  }
};

struct UnholdableClaim {
  double from{0}, to{0};  ///< [rad]
  Twist<2> y = Twist<2>::Zero();
  std::optional<std::vector<double>> rates{};
  std::optional<std::size_t> load{};  ///< that cannot be held, where there are several

  void fields(auto& visit) {
    visit.degrees("from_deg", from, "to_deg", to);
    visit.maybe("load", load);
    visit("y", y);
    visit.maybe("rates", rates);
  }
};

/// The curve of one of several loads.
struct LoadCurveClaim {
  std::vector<ArcClaim> arcs{};
  std::vector<Interval> holdable_arcs_deg{};  ///< [rad]

  void fields(auto& visit) { visit("arcs", arcs, "holdable_arcs_deg", holdable_arcs_deg); }
};

/// A rotation; with its angle where it is a turn.
struct RotationClaim {
  double w{1}, x{0}, y{0}, z{0};
  std::optional<double> angle_deg{};

  void fields(auto& visit) {
    visit("w", w, "x", x, "y", y, "z", z);
    visit.maybe("angle_deg", angle_deg);
  }
};

/// What was asked for: of these what belongs to the command, or was given.
struct OptionsClaim {
  std::optional<Domain> domain{};
  std::optional<double> present_deg{};  ///< in the plane: of ties the least turn from it is first
  double force_cap{0};                  ///< [weights]
  std::optional<Objective> objective{};
  std::optional<double> gap{};
  std::optional<int> max_holds{};
  std::optional<Tilt> tilt{};
  std::optional<RotationClaim> orientation{};
  std::optional<double> safety{}, grip{}, angle_deg{};
  std::optional<std::vector<double>> up{};

  void fields(auto& visit) {
    visit.maybe("domain", domain, "present_deg", present_deg);
    visit("force_cap", force_cap);
    visit.maybe("objective", objective, "gap", gap, "max_holds", max_holds, "tilt", tilt,
                "orientation", orientation);
    visit.maybe("safety", safety, "grip", grip, "angle_deg", angle_deg, "up", up);
  }
};

/// A posture of a turn.
template <int Dim>
struct TurnPostureClaim : HoldClaim<Dim> {
  double turn_deg{0};  ///< so far from the start

  void fields(auto& visit) {
    visit("turn_deg", turn_deg);
    HoldClaim<Dim>::fields(visit);
  }
};

/// Postures of a turn that cannot be held, with one of them.
template <int Dim>
struct StretchClaim {
  double from_deg{0}, to_deg{0};
  TurnPostureClaim<Dim> posture{};

  void fields(auto& visit) { visit("from_deg", from_deg, "to_deg", to_deg, "posture", posture); }
};

/// What a turn takes; null where a posture of it cannot be held.
template <int Dim>
struct PeakClaim {
  double turn_deg{0};  ///< of the whole turn; in the plane counter-clockwise positive
  std::optional<double> peak{}, lower_bound{};
  std::optional<TurnPostureClaim<Dim>> peak_at{};
  std::vector<StretchClaim<Dim>> unholdable{};

  void fields(auto& visit) {
    visit("turn_deg", turn_deg, "peak", peak, "lower_bound", lower_bound, "peak_at", peak_at);
    visit("unholdable", unholdable);
  }
};

/// A part of a wall.
struct WallClaim {
  Vector<3> up;
  Cut cut{};

  void fields(auto& visit) {
    visit("up", up);
    poise::fields(cut, visit);
  }
};

/// The way of least peak, and the wall that proves it.
struct WayClaim {
  Status status{};
  std::optional<double> peak{}, lower_bound{};
  std::vector<RotationClaim> orientations{};
  std::vector<WallClaim> wall{};
  int holds{0};

  void fields(auto& visit) {
    visit("status", status, "peak", peak, "lower_bound", lower_bound);
    visit("orientations", orientations, "wall", wall, "holds", holds);
  }
};

/// The turn from the present posture to another.
template <int Dim>
struct TurnClaim;
template <>
struct TurnClaim<2> : PeakClaim<2> {
  std::optional<PeakClaim<2>> other_way{};

  void fields(auto& visit) {
    PeakClaim<2>::fields(visit);
    visit("other_way", other_way);
  }
};
template <>
struct TurnClaim<3> : PeakClaim<3> {
  RotationClaim rotation{}, orientation{};  ///< the turn, and what it leads to; world frame
  std::optional<WayClaim> way{};            ///< where both ends are held

  void fields(auto& visit) {
    visit("rotation", rotation, "orientation", orientation);
    PeakClaim<3>::fields(visit);
    visit("way", way);
  }
};

/// The best posture that can be reached without pressing harder than now.
template <int Dim>
struct ReachableClaim;
template <>
struct ReachableClaim<2> : TurnPostureClaim<2> {
  double least_turn_deg{0}, most_turn_deg{0};  ///< how far no posture needs more

  void fields(auto& visit) {
    visit("least_turn_deg", least_turn_deg, "most_turn_deg", most_turn_deg);
    TurnPostureClaim<2>::fields(visit);
  }
};
template <>
struct ReachableClaim<3> : HoldClaim<3> {
  Status status{};
  double reachable_bound{0}, peak{0};
  std::vector<RotationClaim> orientations{};
  int holds{0};

  void fields(auto& visit) {
    visit("status", status, "reachable_bound", reachable_bound, "peak", peak);
    visit("orientations", orientations, "holds", holds);
    HoldClaim<3>::fields(visit);
  }
};

template <int Dim>
struct HoldDocument : HoldClaim<Dim> {
  static constexpr const char* command = "hold";
  OptionsClaim options{};

  void fields(auto& visit) {
    visit("options", options);
    HoldClaim<Dim>::fields(visit);
  }
};

template <int Dim>
struct BestDocument {
  static constexpr const char* command = "best";
  OptionsClaim options{};
  Status status{};
  std::optional<MinimumClaim<Dim>> best{}, best_pinched{};
  std::vector<MinimumClaim<Dim>> minima{};
  std::optional<double> lower_bound{}, relative_gap{};
  // In the plane.
  std::optional<OptimumClaim> worst{};
  std::vector<ArcClaim> arcs{};
  std::vector<UnholdableClaim> unholdable_arcs{};
  std::vector<Interval> holdable_arcs_deg{};                 ///< [rad]
  std::optional<std::vector<LoadCurveClaim>> load_curves{};  ///< where there are several
  // In space.
  bool minima_complete{false};
  int holds{0};
  std::vector<Cut> cuts{};
  /// From the present posture to the best; nothing where that was not asked.
  std::optional<TurnClaim<Dim>> turn{};
  std::optional<ReachableClaim<Dim>> without_pressing_harder{};  ///< where the best is not

  void fields(auto& visit) {
    visit("options", options, "status", status, "best", best, "best_pinched", best_pinched);
    visit("minima", minima);
    if constexpr (Dim == 2) visit("worst", worst);
    if constexpr (Dim == 3) visit("minima_complete", minima_complete);
    visit("lower_bound", lower_bound, "relative_gap", relative_gap);
    visit("turn", turn, "without_pressing_harder", without_pressing_harder);
    if constexpr (Dim == 3) return visit("holds", holds, "cuts", cuts);
    visit("arcs", arcs, "unholdable_arcs", unholdable_arcs);
    visit("holdable_arcs_deg", holdable_arcs_deg);
    visit.maybe("load_curves", load_curves);
  }
};

template <int Dim>
struct TurnDocument {
  static constexpr const char* command = "turn";
  OptionsClaim options{};
  HoldClaim<Dim> now{}, then{};
  TurnClaim<Dim> turn{};

  void fields(auto& visit) { visit("options", options, "now", now, "then", then, "turn", turn); }
};

struct CurveDocument {
  static constexpr const char* command = "curve";
  OptionsClaim options{};
  std::vector<OptimumClaim> optima{};
  std::vector<ArcClaim> arcs{};
  std::vector<Interval> holdable_arcs_deg{};                 ///< [rad]
  std::optional<std::vector<LoadCurveClaim>> load_curves{};  ///< where there are several

  void fields(auto& visit) {
    visit("options", options, "optima", optima, "arcs", arcs);
    visit("holdable_arcs_deg", holdable_arcs_deg);
    visit.maybe("load_curves", load_curves);
  }
};

struct DecidingClaim : Deciding {
  std::string finger;

  void fields(auto& visit) {
    visit("finger", finger, "per_newton", per_newton, "slipping", slipping);
  }
};

struct DecidingDriveClaim {
  std::string name;
  double per_newton{0};  ///< of its max, or per newton metre

  void fields(auto& visit) { visit("name", name, "per_newton", per_newton); }
};

/// The weights that can be held.
template <int Dim>
struct WeightClaim {
  double given{0};
  bool holdable{false};
  bool any{false};               ///< any weight, however great
  std::optional<bool> proven{};  ///< told where it is false
  std::optional<double> greatest{}, greatest_bound{};
  Twist<Dim> greatest_dual;
  std::optional<std::vector<double>> greatest_rates{};  ///< of the drives, where any has a max
  std::optional<double> least{};
  double least_bound{0};
  Twist<Dim> least_dual;
  std::optional<std::vector<double>> least_rates{};
  std::optional<HoldClaim<Dim>> greatest_hold{}, least_hold{};
  std::vector<DecidingClaim> contacts{};
  std::vector<DecidingDriveClaim> drives{};

  void fields(auto& visit) {
    visit("given", given, "holdable", holdable, "any", any);
    visit.maybe("proven", proven);
    visit("greatest", greatest);
    visit("greatest_bound", greatest_bound, "greatest_dual", greatest_dual);
    visit.maybe("greatest_rates", greatest_rates);
    visit("least", least, "least_bound", least_bound, "least_dual", least_dual);
    visit.maybe("least_rates", least_rates);
    if (!holdable) return;
    visit("greatest_hold", greatest_hold);
    visit.maybe("least_hold", least_hold);
    visit("contacts", contacts, "drives", drives);
  }
};

/// The least friction with which the weight is held.
template <int Dim>
struct FrictionClaim {
  std::optional<double> factor{};
  double bound{0};
  std::optional<bool> proven{};  ///< told where it is false
  Twist<Dim> dual;
  std::optional<std::vector<double>> rates{};  ///< of the drives, where any has a max
  std::optional<HoldClaim<Dim>> hold{};

  void fields(auto& visit) {
    visit("factor", factor, "bound", bound);
    visit.maybe("proven", proven);
    visit("dual", dual);
    visit.maybe("rates", rates);
    visit("hold", hold);
  }
};

/// What proves how much is withstood: the hull of what is held, and a half-space.
template <int Dim>
struct ShakeProofClaim {
  Twist<Dim> y;
  std::optional<std::vector<double>> rates{};  ///< of the drives, where any has a max
  std::vector<Vector<Dim>> held{};

  void fields(auto& visit) {
    visit("y", y);
    visit.maybe("rates", rates);
    visit("held", held);
  }
};

/// The acceleration that is withstood in every direction.
template <int Dim>
struct ShakeClaim {
  std::optional<double> acceleration{}, bound{};  ///< null: infinite
  std::optional<Vector<Dim>> direction{};         ///< null without a bound
  std::optional<bool> proven{};                   ///< told where it is false
  ShakeProofClaim<Dim> proof{};                   ///< held: accelerations

  void fields(auto& visit) {
    visit("acceleration", acceleration, "bound", bound, "direction", direction);
    visit.maybe("proven", proven);
    visit("proof", proof);
  }
};

/// How far the posture may be tilted.
template <int Dim>
struct TiltClaim {
  double bound{0};                       ///< [rad]
  std::optional<Vector<Dim>> weakest{};  ///< the posture so far away; null where all are held
  std::optional<bool> proven{};          ///< told where it is false
  ShakeProofClaim<Dim> proof{};          ///< held: vectors in place of up

  void fields(auto& visit) {
    visit.degrees("bound_deg", bound);
    visit("weakest", weakest);
    visit.maybe("proven", proven);
    visit("proof", proof);
  }
};

/// What a gripper can hold in a posture, against one load.
template <int Dim>
struct CapacityClaim {
  std::string posture;
  Vector<Dim> up;
  double angle_deg{0};                ///< in the plane
  std::optional<std::size_t> load{};  ///< where there are several
  WeightClaim<Dim> weight{};
  FrictionClaim<Dim> friction{};
  HoldClaim<Dim> command{};
  ShakeClaim<Dim> shake{};
  double tilted{0};  ///< [rad]
  TiltClaim<Dim> tilt{};

  void fields(auto& visit) {
    visit("posture", posture, "up", up);
    if constexpr (Dim == 2) visit("angle_deg", angle_deg);
    visit.maybe("load", load);
    visit("weight", weight, "friction", friction, "command", command, "shake", shake);
    visit.degrees("tilt_deg", tilted);
    visit("tilt", tilt);
  }
};

template <int Dim>
struct CapacityDocument {
  static constexpr const char* command = "capacity";
  OptionsClaim options{};
  std::vector<CapacityClaim<Dim>> capacities{};

  void fields(auto& visit) { visit("options", options, "capacities", capacities); }
};

/// Bounds what all postures withstand.
template <int Dim>
struct SturdyCutClaim {
  std::optional<std::size_t> load{};  ///< where there are several
  Twist<Dim> y;
  std::optional<std::vector<double>> rates{};  ///< of the drives, where any has a max

  void fields(auto& visit) {
    visit.maybe("load", load);
    visit("y", y);
    visit.maybe("rates", rates);
  }
};

/// The posture that withstands most.
template <int Dim>
struct SturdyDocument {
  static constexpr const char* command = "sturdiest";
  OptionsClaim options{};
  Status status{};
  std::optional<Vector<Dim>> up{};          ///< null where none was found
  std::optional<double> angle_deg{};        ///< in the plane
  std::optional<double> acceleration{};     ///< null: infinite, or no posture was found
  std::optional<double> bound{};            ///< of all postures; null: infinite
  std::vector<ShakeClaim<Dim>> shakes{};    ///< in it, of each load
  std::vector<SturdyCutClaim<Dim>> cuts{};  ///< that prove the bound
  int holds{0};

  void fields(auto& visit) {
    visit("options", options, "status", status, "up", up);
    if constexpr (Dim == 2) visit("angle_deg", angle_deg);
    visit("acceleration", acceleration, "bound", bound, "shakes", shakes, "holds", holds);
    visit("cuts", cuts);
  }
};

/// The grasp as it was understood.
template <int Dim>
struct CheckDocument {
  int dimension{Dim};
  double safety{1};
  std::vector<Load<Dim>> loads{};
  std::vector<Contact<Dim>> contacts{};
  bool force_closure{false};
  // In the plane.
  std::optional<double> angle_deg{};
  Domain domain{};
  std::optional<Interval> fork{};
  // In space.
  std::optional<Vector<3>> up{};
  std::optional<Tilt> tilt{};
};

}  // namespace poise
