// The least grip in the plane is a linear program: docs/theory.md, "The grip curve". Not installed.
#pragma once

#include <optional>
#include <vector>

#include "dual/interior.hpp"

namespace poise::dual {

/// Coefficients of (1, cos theta, sin theta).
using Affine = Eigen::RowVector3d;

/// The least grip against all loads near one for which it was sought, and what attains and proves
/// it there.
struct GripPiece {
  Affine F;
  Twist<2> y;
  std::vector<double> rates;                 ///< of the drives, >= 0, with a sum of at most 1
  std::vector<Affine> normals, tangentials;  ///< of the contacts
  /// It is valid where none of these is negative.
  std::vector<Affine> conditions;
  double rounding{0};  ///< of the conditions
};

/// minimise F  subject to  Σ G f = w(theta), f in the cones, e_a <= F, F >= 0, for a hand in the
/// units of cone_hand(). Both edges of a cone are columns, so that all unknowns are >= 0.
class GripProgram {
 public:
  /// `load`: coefficients of (1, cos theta, sin theta), one row for each component of w.
  GripProgram(const ConeHand<2>& hand, const Eigen::Matrix3d& load);

  /// The piece around a posture; nothing where there are no forces, or rounding leaves none.
  std::optional<GripPiece> at(double theta);

 private:
  /// A x = right (1, cos theta, sin theta), with one slack or forbidden unknown a row, first.
  struct Tables {
    Eigen::MatrixXd A, right;
    Eigen::Index rows() const { return A.rows(); }
  };
  template <class T>
  class Simplex;

  ConeHand<2> hand_;
  Tables tables_;
  Eigen::Index limits_;  ///< the first row of a limit
  std::vector<Eigen::Index> basis_;
};

}  // namespace poise::dual
