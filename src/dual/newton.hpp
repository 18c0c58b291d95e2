// The linear algebra of a step: small symmetric matrices, given by their upper triangle. Not
// installed.
#pragma once

#include <algorithm>

#include "dual/tolerances.hpp"
#include "dual/wide.hpp"

namespace poise::dual {

template <class T, int n>
using SmallSquare = Eigen::Matrix<T, n, n>;
template <class T, int n>
using SmallColumn = Eigen::Matrix<T, n, 1>;

/// x = M⁻¹ r for positive semidefinite M, by M = LDLᵀ. Directions in which M vanishes get very long
/// steps, not none: a pivot is known to within rounding of its own diagonal entry.
template <class T, int n>
[[gnu::always_inline]] inline SmallColumn<T, n> newton_step(const SmallSquare<T, n>& M,
                                                            const SmallColumn<T, n>& r) {
  constexpr double rounding = 4.5 * rounding_of<T>, least = rounding * rounding;
  T A[n][n + 1], over[n];  // what is left of M and r, row by row
#pragma GCC unroll 6
  for (int i = 0; i < n; ++i) {
#pragma GCC unroll 6
    for (int j = i; j < n; ++j) A[i][j] = M(i, j);
    A[i][n] = r[i];
  }
#pragma GCC unroll 6
  for (int j = 0; j < n; ++j) {
    const T pivot = std::max<T>(A[j][j], rounding * M(j, j) + least);
    over[j] = 1 / pivot;
#pragma GCC unroll 6
    for (int i = j + 1; i < n; ++i) {
      const T part = A[j][i] * over[j];
#pragma GCC unroll 7
      for (int k = i; k <= n; ++k) A[i][k] -= part * A[j][k];
    }
  }
  SmallColumn<T, n> x;
#pragma GCC unroll 6
  for (int j = n - 1; j >= 0; --j) {
    T sum = A[j][n];  // the newest x is needed last
#pragma GCC unroll 6
    for (int k = n - 1; k > j; --k) sum -= A[j][k] * x[k];
    x[j] = sum * over[j];
  }
  return x;
}

/// M⁻¹ of a full positive definite M, by sweeps, which are LDLᵀ in place. False where a pivot is
/// not above `least`.
template <int n>
bool invert(SmallSquare<double, n>& M, double least) {
#pragma GCC unroll 6
  for (int k = 0; k < n; ++k) {
    const double pivot = M(k, k);
    if (!(pivot > least)) return false;
    const double over = 1 / pivot;
    const SmallColumn<double, n> column = M.col(k), part = column * over;
    M.noalias() -= column * part.transpose();
    M.row(k) = part.transpose();
    M.col(k) = part;
    M(k, k) = -over;
  }
  M = -M;
  return true;
}

/// xᵀ M x.
template <class T, int n>
T quadratic(const SmallSquare<T, n>& M, const SmallColumn<T, n>& x) {
  T all_rows = 0;
  for (int i = 0; i < n; ++i) {
    T row = T(0.5) * M(i, i) * x[i];
    for (int j = i + 1; j < n; ++j) row += M(i, j) * x[j];
    all_rows += 2 * x[i] * row;
  }
  return all_rows;
}

}  // namespace poise::dual
