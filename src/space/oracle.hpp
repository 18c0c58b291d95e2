// What the search for the posture of least effort asks: value and cut at x. Not installed.
//
// The searches know no more of the objective than this file says. Another objective is another
// struct with these functions; its sublevel sets {x : value(x) <= t} must be convex.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "dual/dual.hpp"
#include "dual/interior.hpp"
#include "poise/best_posture.hpp"
#include "space/directions.hpp"

namespace poise::search {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// A load in the units of the search: efforts in squares of the largest load's size. As a function
/// of x, the posture or any other vector, it is w(x) = turning (x, arm x x) + still in its own size.
struct ScaledLoad {
  ScaledLoad(const ScaledHand<3>& hand, const Load<3>& load, double largest, double force_cap);

  Wrench<3> at(const Vector<3>& x) const {
    Wrench<3> w = still;
    w.head<3>() += turning * x;
    w.tail<3>() += turning * arm.cross(x);
    return w;
  }
  /// What x does against y: its product with this.
  Vector<3> velocity(const Twist<3>& y) const {
    return turning * (y.head<3>() + Vector<3>(y.tail<3>()).cross(arm));
  }

  dual::Problem<3> problem;
  Vector<3> arm;    ///< from the hand's center to the com, in radii
  double turning;   ///< what turns with x, in its own size
  Wrench<3> still;  ///< what does not, in its own size
  double size;      ///< in that of the largest
  double unit;      ///< size^2: of its efforts
  double cap;       ///< in its own size
};
std::vector<ScaledLoad> scaled_loads(const Grasp<3>& grasp, const ScaledHand<3>& hand,
                                     double force_cap);

/// The x with normal . x <= Oracle::offset(.., t): all whose value is at most t lie there.
struct HalfSpace {
  enum class Origin {
    held,        ///< touches a sublevel set, at x
    unholdable,  ///< separates x from what can be held
    domain,      ///< bounds the domain
  };
  Origin origin{Origin::unholdable};
  Vector<3> normal = Vector<3>::Zero();  ///< of length 1
  Vector<3> x = Vector<3>::Zero();       ///< what was asked when it was found
  // For the oracle: effort >= size^2 2 (speed normal . x - phi) for the load.
  std::size_t load{0};
  Twist<3> y = Twist<3>::Zero();  ///< about the center, in the solver's units
  double speed{0};                ///< the length of the load's velocity(y)
  double phi{0};                  ///< phi(G^T y) - y . still
  /// Of a general oracle the rates of the drives; to the grip phi is what contacts with limits can
  /// do: rate_sum grip >= size (speed normal . x - phi).
  std::vector<double> rates{};
  double rate_sum{0};
};

/// The half-spaces of a vertex; null for a side of the cube.
using Corner = std::array<const HalfSpace*, 3>;
/// Of those that touch a sublevel set the one found nearest to x; null where there is none.
const HalfSpace* nearest_held(const Vector<3>& x, const Corner& corner);

/// The value at x, infinite where unholdable, and a half-space by which it shows.
struct Answer {
  double value{infinity};
  HalfSpace half_space;
};

/// How exact values are.
enum class Digits {
  rough,      ///< as doubles give them at once: for what needs no proof
  as_needed,  ///< all, where the value improves
  all,        ///< all, and in wider numbers where doubles leave it open whether x can be held
};

/// What an answer is for.
struct Aim {
  const HalfSpace* start;  ///< found near x: where to start from; or null
  double best;             ///< the least value known
  double improvement;      ///< lower values are better
  double target;           ///< of half-spaces those for this t are wanted
  Digits digits;
  /// If not 0: what the value at x is proven to exceed already. Where the value is no less than
  /// `best`, the answer may then be a lower bound.
  double proven{0};
};

/// The greatest effort of the loads, or the square of the greatest grip. That of the grip, of hands
/// with pads and of drives with a max is found by the interior-point method, where ascent leaves it
/// open.
class Oracle {
 public:
  Oracle(const Grasp<3>& grasp, const std::vector<ScaledLoad>& loads,
         Objective objective = Objective::effort);

  /// The half-space is right in any case.
  Answer evaluate(const Vector<3>& x, const Aim& aim);
  double offset(const HalfSpace& half_space, double t) const;
  /// The least value that the half-space leaves to x with normal . x = along; infinite where it
  /// proves that they are unholdable.
  double value_proven(const HalfSpace& half_space, double along) const;
  /// All x whose value is at most t have no greater coordinates, if this is finite.
  double half_width(double t) const;
  /// A half-space that another oracle found for the same loads, with the limits of this one.
  HalfSpace adopted(const HalfSpace& known) const;
  /// Where to start from at a corner.
  std::optional<HalfSpace> start_at(const Vector<3>& x, const Corner& corner) const;
  /// As a cut that proves t: a half-space, or a side of the cube of half_width(t), numbered as by
  /// Polytope.
  Cut cut(const HalfSpace& half_space, double t) const;
  Cut side_of_cube(int side, double t) const;

  bool is_gauge;    ///< whether the root of the value is one: value(s x) = s^2 value(x)
  bool scales;      ///< whether it is, as far as the value is at most `most`
  double least{0};  ///< no unit vector has a lower value: forces add up to the weight
  double most{0};   ///< greater values count as unholdable
  double unit;      ///< the root of a value of 1 [N, or as grip is told]
  int holds{0};     ///< answers so far, each about all loads
  std::vector<Vector<3>> candidates;  ///< postures that may be lone minima
  /// Of motions that no contact resists, and the planes of x that these leave.
  std::vector<HalfSpace> unresisted;
  std::vector<Plane> thin;

 private:
  double effort(const ScaledLoad& load, const Wrench<3>& w, const Twist<3>& start, const Aim& aim,
                dual::Point<3>& point);
  HalfSpace half_space(const dual::Point<3>& point, std::size_t load, const Vector<3>& x,
                       HalfSpace::Origin origin) const;
  void deepen(const ScaledLoad& load, const Wrench<3>& w, double t, dual::Point<3>& point) const;
  double stretch(const HalfSpace& half_space, double half) const;
  Cut cut_by(std::size_t load, const Twist<3>& y) const;
  Answer general_answer(const Vector<3>& x, double target);
  bool quick_grip(std::size_t load, const Vector<3>& x, Answer& answer) const;
  Answer answer_by_interior(std::size_t load, const Vector<3>& x, double target) const;
  HalfSpace general_half_space(std::size_t load, const Twist<3>& y, const Vector<3>& x) const;
  bool is_grip() const { return objective_ == Objective::grip; }

  const Grasp<3>& grasp_;
  const std::vector<ScaledLoad>& loads_;
  Objective objective_;
  std::vector<dual::ConeHand<3>> cones_;  ///< of a general oracle, in units of each load
  double shares_{0};
  std::size_t largest_{0};
  int contradicted_{0};  ///< holds that turned out to be none
};

}  // namespace poise::search
