// The search for the posture of least effort: docs/theory.md, "The farthest point of a convex
// body". Not installed.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "dual/dual.hpp"
#include "poise/best_posture.hpp"
#include "space/directions.hpp"
#include "space/polytope.hpp"


namespace poise::search {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// A load in the units of the search: efforts in squared weights of the heaviest. As a function of
/// x, the posture or any other vector, it is w(x) = (x, arm x x) + fixed in its own weights.
struct Case {
  Case(const ScaledHand<3>& hand, const Load<3>& load, double heaviest, double force_cap);

  Wrench<3> at(const Vector<3>& x) const {
    Wrench<3> w = fixed;
    w.head<3>() += x;
    w.tail<3>() += arm.cross(x);
    return w;
  }
  /// The velocity under y of the point where the weight acts.
  Vector<3> velocity(const Twist<3>& y) const {
    return y.head<3>() + Vector<3>(y.tail<3>()).cross(arm);
  }

  dual::Problem<3> problem;
  Vector<3> arm;    ///< from the hand's center to the com, in radii
  Wrench<3> fixed;  ///< in its own weights
  double weight;    ///< in weights of the heaviest
  double cap;       ///< in its own weights
};

/// For every x in R^3 and w(x) of the load: effort >= weight^2 2 (v . x - phi), v the velocity of the
/// com under y. Or a plane n . x <= 0 of the domain.
struct Row {
  Vector<3> n;  ///< v / |v|
  double speed{0};
  double phi{0};                  ///< phi(G^T y) - y . fixed
  Twist<3> y = Twist<3>::Zero();  ///< about the center, in the solver's units
  std::size_t load{0};
  Vector<3> at = Vector<3>::Zero();  ///< where y is optimal
  bool holdable{false}, plane{false};
};

/// An x whose effort is known.
struct Known {
  Vector<3> x;
  double V;
};

struct Evaluation {
  double V{infinity};  ///< infinite where unholdable
  Row row;
};

/// The postures in which one contact may carry all: it is right under the com, or above it.
std::vector<Vector<3>> on_one_contact(const Grasp<3>& grasp);

/// Minimises the greatest effort of the loads over the unit vectors of all cones.
class Search {
 public:
  /// `rough`: with holds to the digits that doubles give at once, for what needs no proof.
  Search(const Grasp<3>& grasp, const std::vector<Case>& cases, std::vector<Cone> cones, double gap, int max_holds,
         bool rough = false);

  /// V at the weight `given` (unit vector: a posture), from the y of a row.
  /// Where it is far from the best, V is only rough; the row is right in any case.
  /// `known`, if not 0: an effort that is proven for it already. Where V is no less than the best
  /// it may then be a lower bound.
  Evaluation evaluate(const Vector<3>& given, const Row* from = nullptr, bool exact = false,
                      double known = 0);

  void run();
  /// Takes over what was found for the same loads without max_normal.
  void begin_with(const Search& easier);

  /// Turns that nobody feels leave only loads on these planes.
  const std::vector<Plane>& thin() const { return thin_; }
  double best_V() const { return best_V_; }
  const Vector<3>& best_up() const { return best_up_; }
  const Row& best_row() const { return best_row_; }
  int holds() const { return holds_; }
  double cap() const { return cap_; }
  /// What the rows prove: V >= lower_bound() in the domain.
  double lower_bound();
  /// The rows that are needed for that, as cuts.
  std::vector<Cut> certificate(double t) const;

 private:
  /// With limits loads near the unit sphere are all that counts.
  Polytope box() const;
  /// The effort whose level set is cut: with limits the rows' right-hand sides depend on it. Where
  /// nothing holds, a little above the cap, which proofs exceed by a tenth.
  double target() const;
  double stretch(const Row& row, double half) const;
  double right_hand_side(const Row& row) const;
  bool cut(std::size_t row, std::size_t hint);
  void rebuild(double t);
  /// By more than the wanted gap would notice.
  bool improves(double V) const { return V < (1 - 1e-3 * gap_) * best_V_; }
  /// Between the target and the best.
  bool below(double V) const { return V < infinity && V <= (1 - 0.5 * gap_) * best_V_; }
  bool inside(const Vector<3>& up) const;
  /// Evaluates, remembers the row and whether it is the best.
  double visit(const Vector<3>& up, const Row* from, std::size_t hint = Polytope::none,
               double known = 0);
  Row row(const dual::Point<3>& point, std::size_t load, const Vector<3>& at,
          bool holdable) const;
  std::optional<Row> beside(const Vector<3>& x, const std::array<int, 3>& planes) const;
  std::vector<Plane> meant(const Vector<3>& x, const std::array<int, 3>& planes) const;
  Vector<3> snapped(const Vector<3>& x, const std::array<int, 3>& planes) const;
  const Row* neighbour(const Vector<3>& x, const std::array<int, 3>& planes) const;
  bool stay_inside(const Vector<3>& x, const std::array<int, 3>& planes, std::size_t vertex);
  bool shrink();
  bool recede();
  bool cross();
  bool proven() const;
  double bound_by_cuts();
  void nothing_resists(std::size_t load, const Twist<3>& y);

  const Grasp<3>& grasp_;
  const std::vector<Case>& cases_;
  std::vector<Cone> cones_;
  double gap_;
  int max_holds_, holds_{0};
  bool rough_, limited_{false}, heavier_is_easier_{false};
  double cap_{0}, shares_{0}, t_{1};
  double least_{0};  ///< effort that forces need to add up to the weight
  std::size_t heaviest_{0};
  std::vector<Plane> thin_;
  std::vector<Row> rows_;  ///< plane 6 + i of the polytope is row i
  Polytope polytope_{1};
  double best_V_{infinity};
  Vector<3> best_up_ = Vector<3>::Zero();
  Row best_row_;
  int beyond_in_a_row_{0}, refuted_{0};
  int nearness_{1};  ///< how often the way from a vertex to the inside is halved
  /// Loads of the domain known to need no more: lighter than the object, and heavier.
  std::optional<Known> lighter_, heavier_;
};

}  // namespace poise::search
