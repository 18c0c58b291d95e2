// The search for the posture of least effort: docs/theory.md, "The farthest point of a convex
// body". Not installed.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "space/directions.hpp"
#include "dual/dual.hpp"
#include "poise/best_spatial_posture.hpp"
#include "space/polytope.hpp"
#include "dual/scaled_grasp.hpp"

namespace poise::search {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// A scenario in the units of the search: efforts in squared weights of the heaviest.
struct Scenario {
  const Grasp<3>* grasp;
  double weight;  ///< in weights of the heaviest
  double cap;     ///< in its own weights
};

/// For every x in R^3, load x through the com of the scenario: effort >= weight^2 2 (v . x - phi),
/// v the velocity of the com under y. Or a plane n . x <= 0 of the domain.
struct Row {
  Vector<3> n;  ///< v / |v|
  double speed{0}, phi{0};
  Twist<3> y = Twist<3>::Zero();  ///< about the com, in the solver's units
  std::size_t scenario{0};
  Vector<3> at = Vector<3>::Zero();  ///< where y is optimal
  bool holdable{false}, plane{false};
};

struct Load {
  Vector<3> x;
  double V;
};

struct Evaluation {
  double V{infinity};  ///< infinite where unholdable
  Row row;
};

/// The postures in which one contact may carry all: it is right under the com, or above it.
std::vector<Vector<3>> on_one_contact(const Grasp<3>& grasp);

/// Minimises the greatest effort of the scenarios over the unit vectors of all cones.
class Search {
 public:
  /// `rough`: with holds to the digits that doubles give at once, for what needs no proof.
  Search(const std::vector<Scenario>& scenarios, std::vector<Cone> cones, double gap, int max_holds,
         bool rough = false);

  /// V at the weight `given` (unit vector: a posture), from the y of a row.
  /// Where it is far from the best, V is only rough; the row is right in any case.
  /// `known`, if not 0: an effort that is proven for it already. Where V is no less than the best
  /// it may then be a lower bound.
  Evaluation evaluate(const Vector<3>& given, const Row* from = nullptr, bool exact = false,
                      double known = 0);

  void run();
  /// Takes over what was found for the same scenarios without max_normal.
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
  Row row(const dual::Point<3>& point, std::size_t scenario, const Vector<3>& at,
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
  void nothing_resists(std::size_t scenario, const Twist<3>& y);

  const std::vector<Scenario>& scenarios_;
  std::vector<Cone> cones_;
  double gap_;
  int max_holds_, holds_{0};
  bool rough_, limited_{false}, heavier_is_easier_{false};
  double cap_{0}, shares_{0}, t_{1};
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
  std::optional<Load> lighter_, heavier_;
};

}  // namespace poise::search
