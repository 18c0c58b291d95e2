// The arc of the posture curve around one posture: docs/theory.md, "The posture curve". Not
// installed.
#pragma once

#include "dual/cone_plane.hpp"
#include "dual/dual.hpp"
#include "plane/reach.hpp"
#include "poise/posture_curve.hpp"

namespace poise {

/// A load in the solver's units as a function of the posture: coefficients of (1, cos theta,
/// sin theta), one row for each component.
using LoadCurve = Eigen::Matrix3d;
LoadCurve load_curve(const ScaledHand<2>& hand, double weight, const Load<2>& load);

/// Solves for arcs, in numbers of type T.
template <class T>
class ArcSolver {
 public:
  ArcSolver(const Cones<2, T>& cones, const LoadCurve& load);

  /// The arc around the posture of `reach`, from the faces to which `point` projects there: y (a
  /// twist about the com in the solver's units), V [weights^2], and how far the faces stay valid.
  /// False where they do not balance the neighbouring postures: the posture is an arc of its own.
  bool solve(const dual::Point<2, T>& point, Reach& reach, Arc& arc);
  /// What contact i does all along the arc last solved for.
  ArcState state(std::size_t i) const;

 private:
  /// Coefficients of (1, cos theta, sin theta), one row for each component.
  template <int Rows>
  using Affine = Eigen::Matrix<T, Rows, 3>;
  using Row = Eigen::Matrix<T, 1, 3>;

  struct Contact {
    Eigen::Matrix<T, 3, 2> G;  ///< its columns of the grasp matrix
    T mu, edge, lo, hi;
    dual::Face<T> face;
    Affine<2> F, Z;  ///< its force, and G^T y
  };

  Harmonic2 effort() const;
  template <int First, int Columns>
  void balance(const dual::Square<2, T>& inverse, const Eigen::Matrix<T, 3, Columns>& load,
               Eigen::Matrix<T, 3, Columns> residual, bool free_turn, Affine<3>& Y,
               T& largest_force);
  enum class Of { force, motion };  ///< what a condition is of
  template <class Function>
  static void for_each_condition(const Contact& contact, const Function& f);
  Row turn_at(const Reach& reach, const Affine<3>& Y) const;

  bool limited_;  ///< whether y and the forces have a constant part
  Affine<3> load_;
  SmallVector<Contact, 16> contacts_;
};

}  // namespace poise
