// What the searches for the posture of least effort share. Not installed.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "space/oracle.hpp"
#include "space/polytope.hpp"

namespace poise::search {

/// Shorter x have no direction.
inline constexpr double no_direction = 1e-3;
/// Where the value is no gauge x near the unit sphere are all that counts: the polytope is cut from
/// a cube of this half width.
inline constexpr double half_of_limited_cube = 2;

/// No unit vector is left: what is left is shorter, or longer.
bool leaves_no_posture(const Polytope& polytope);

/// The half-spaces found so far, the polytope that they leave of the x that may need no more than
/// the target, and the best posture found in the domain.
struct SearchState {
  /// `domain`: postures in all of these cones. `gap`: wanted. `digits`: rough or as_needed.
  SearchState(Oracle oracle, std::vector<TiltCone> domain, double gap, Digits digits);
  /// Takes over what was found for the same loads with other limits.
  void begin_with(const SearchState& other);

  Oracle oracle;
  std::vector<TiltCone> domain;
  double gap;
  Digits digits;
  std::vector<HalfSpace> half_spaces;  ///< plane cube_sides + i of the polytope is half-space i
  /// The value whose sublevel set is cut out, or that of which to prove that nothing needs less.
  double target{1};
  Polytope polytope{1};
  double best_value{infinity};
  HalfSpace best;  ///< of the best posture, best.x

  /// The target that the best value asks for. Where nothing holds, a little above what counts as
  /// held, which proofs exceed by a tenth.
  double wanted_target() const;
  /// The polytope anew, for another target.
  void rebuild(double new_target);

  Answer evaluate(const Vector<3>& x, const HalfSpace* start = nullptr) {
    return evaluate(x, start, digits);
  }
  Answer evaluate(const Vector<3>& x, const HalfSpace* start, Digits how, double proven = 0);
  /// Evaluates x, and cuts, at a vertex or anywhere. The value.
  double cut_at(const Vector<3>& x, const HalfSpace* start = nullptr,
                std::size_t vertex = Polytope::none);
  double cut_exactly_at(const Vector<3>& x, const HalfSpace* start, std::size_t vertex);
  /// The same for a posture, which may be the best.
  double visit(const Vector<3>& up, const HalfSpace* start = nullptr,
               std::size_t vertex = Polytope::none, double proven = 0);
  /// A point from which to look at the border of what can be held: the best posture, or the middle
  /// of the polytope.
  Vector<3> inside() const { return best_value < infinity ? best.x : polytope.middle(); }
  /// Visits the posture a part of the way from `up`, beside what can be held, to inside(), or
  /// inside() itself where nothing held. Whether it holds.
  bool visit_towards(const Vector<3>& inside, const Vector<3>& up, const Polytope::Planes& planes,
                     double part);
  /// Cuts off an x outside of the domain, at a vertex or anywhere. True if there was need.
  bool cut_to_domain(const Vector<3>& x, const Polytope::Planes& planes, std::size_t vertex);

  /// Of planes of the polytope. Valid until the next cut.
  Corner corner(const Polytope::Planes& planes) const;
  /// Where what can be held has no inside, the planes that leave nothing else are meant to be hit:
  /// what is a little beside them is so by rounding. The point of them nearest to x.
  OnPlanes on_tight_planes(const Vector<3>& x, const Polytope::Planes& planes) const;
  /// The posture in the direction of x, on these planes.
  Vector<3> posture_towards(const Vector<3>& x, const Polytope::Planes& planes) const {
    const Vector<3> up = x.normalized();
    return on_tight_planes(up, planes).posture(up);
  }
  bool is_in_domain(const Vector<3>& up) const;
  /// Whether what was found proves that the posture is not better than the best.
  bool is_cut_off(const Vector<3>& up) const;

 private:
  Polytope cube() const;
  double improvement() const { return (1 - 1e-3 * gap) * best_value; }  // that the gap would notice
  Vector<3> snapped(const Vector<3>& x) const;
  double cut_by(const Answer& answer, std::size_t vertex);
  bool cut(std::size_t half_space, std::size_t vertex = Polytope::none);
};

/// How near to the border of what can be held to look from the inside, after vertices again and
/// again lay outside of it: as near as there are holds.
class Nearness {
 public:
  static constexpr int most_halvings = 40;
  /// Whether it is time to look, after a vertex where something holds or nothing does.
  bool is_due(bool holds) {
    refused_in_a_row_ = holds ? 0 : refused_in_a_row_ + 1;
    return refused_in_a_row_ >= 2;
  }
  /// Of the way from the vertex to the inside.
  double part() const { return std::ldexp(1, -halvings_); }
  void update(bool holds) {
    halvings_ = std::clamp(halvings_ + (holds ? 1 : -1), 1, most_halvings);
  }

 private:
  int refused_in_a_row_{0}, halvings_{1};
};

}  // namespace poise::search
