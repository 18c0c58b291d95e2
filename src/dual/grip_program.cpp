#include "dual/grip_program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "dual/wide.hpp"

namespace poise::dual {
namespace {

using Eigen::Index;

constexpr Index balance_rows = 3;
/// What rounding may make of an unknown that is 0, and of a pivot; of the largest, in T.
template <class T>
constexpr double small = std::is_same_v<T, double> ? 1e-11 : 1e-22;
template <class T>
constexpr double least_pivot = std::is_same_v<T, double> ? 1e-9 : 1e-20;
/// From so many pivots on the first that will do is taken: then the way ends.
constexpr int greedy_pivots = 60, most_pivots = 2000;

}  // namespace

/// The dual simplex method. The first basis is the slacks; with costs >= 0 it is dual feasible, and
/// so is every basis that was optimal, whatever the load.
template <class T>
class GripProgram::Simplex {
 public:
  using Table = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using Row = Eigen::Matrix<T, 1, 3>;

  explicit Simplex(const Tables& tables)
      : rows_(tables.rows()), columns_(tables.A.cols()), table_(rows_ + 1, columns_ + 3) {
    table_.topLeftCorner(rows_, columns_) = tables.A.template cast<T>();
    table_.topRightCorner(rows_, 3) = tables.right.template cast<T>();
    table_.row(rows_).setZero();
    table_(rows_, columns_ - 1) = 1;  // F is all that costs
    basis_.resize(static_cast<std::size_t>(rows_));
    std::iota(basis_.begin(), basis_.end(), Index{0});
  }

  /// Goes to a basis by pivots in its columns. False: it is as good as singular.
  bool go_to(const std::vector<Index>& basis) {
    std::vector<bool> done(static_cast<std::size_t>(rows_), false);
    for (const Index column : basis)
      if (column < rows_) done[static_cast<std::size_t>(column)] = true;
    for (const Index column : basis) {
      if (column < rows_) continue;
      Index best = -1;
      for (Index row = 0; row < rows_; ++row)
        if (!done[static_cast<std::size_t>(row)] &&
            (best < 0 || size(table_(row, column)) > size(table_(best, column))))
          best = row;
      if (best < 0 || !(size(table_(best, column)) > least_pivot<T>)) return false;
      pivot(best, column);
      done[static_cast<std::size_t>(best)] = true;
    }
    return true;
  }

  /// An optimal basis at the posture with these (1, cos theta, sin theta). False: there is none.
  bool solve(const Vector<3>& posture) {
    const Eigen::Matrix<T, 3, 1> here = posture.template cast<T>();
    for (int k = 0; k < most_pivots; ++k) {
      const bool greedy = k < greedy_pivots;
      Index row = -1;
      T worst = small<T> * largest(here);
      for (Index i = 0; i < rows_ && (greedy || row < 0); ++i) {
        const T value = right(i).dot(here.transpose());
        const T outside = is_forbidden(i) ? size(value) : T(-value);
        if (!(outside > worst)) continue;
        row = i;
        if (greedy) worst = outside;
      }
      if (row < 0) return true;
      const Index column = entering(row, right(row).dot(here.transpose()) > 0, greedy);
      if (column < 0) return false;
      pivot(row, column);
    }
    return false;
  }

  const std::vector<Index>& basis() const { return basis_; }
  Row right(Index row) const { return table_.template block<1, 3>(row, columns_); }
  /// Σ rows of A times these is the cost of a column, at most.
  T multiplier(Index row) const { return -table_(rows_, row); }
  /// Balance has no slack: what stands in for it must be 0.
  bool is_forbidden(Index row) const {
    return basis_[static_cast<std::size_t>(row)] < balance_rows;
  }

 private:
  static T size(const T& x) { return x < 0 ? T(-x) : x; }
  T largest(const Eigen::Matrix<T, 3, 1>& here) const {
    T most = 1;
    for (Index i = 0; i < rows_; ++i)
      most = std::max<T>(most, size(right(i).dot(here.transpose())));
    return most;
  }
  /// The column that keeps all reduced costs >= 0, and of those the largest pivot.
  Index entering(Index row, bool falls, bool greedy) const {
    Index best = -1;
    T ratio = 0, pivot = 0;
    for (Index j = balance_rows; j < columns_; ++j) {
      const T entry = falls ? table_(row, j) : T(-table_(row, j));
      if (!(entry > least_pivot<T>)) continue;
      const T cost = std::max<T>(table_(rows_, j), 0), here = cost / entry;
      const T tie = small<T> * (1 + ratio);
      const bool better = best < 0 || here < ratio - tie;
      if (!better && !(greedy && here <= ratio + tie && entry > pivot)) continue;
      best = j;
      ratio = better ? here : std::min<T>(ratio, here);
      pivot = entry;
    }
    return best;
  }
  void pivot(Index row, Index column) {
    table_.row(row) *= 1 / table_(row, column);
    table_(row, column) = 1;
    for (Index i = 0; i <= rows_; ++i) {
      if (i == row || table_(i, column) == 0) continue;
      const T times = table_(i, column);
      table_.row(i) -= times * table_.row(row);
      table_(i, column) = 0;
    }
    basis_[static_cast<std::size_t>(row)] = column;
  }

  Index rows_, columns_;
  Table table_;
  std::vector<Index> basis_;  ///< the unknown of each row
};

GripProgram::GripProgram(const ConeHand<2>& hand, const Eigen::Matrix3d& load) : hand_(hand) {
  const auto drives = static_cast<Index>(hand.drives.size());
  Index edges = 0, limits = 0;
  for (const ConeContact<2>& contact : hand.contacts) {
    edges += contact.first == contact.last ? 1 : 2;
    limits += (contact.lo > 0 ? 1 : 0) + (std::isfinite(contact.hi) ? 1 : 0);
  }
  limits_ = balance_rows + drives;
  const Index rows = limits_ + limits;
  tables_.A.setZero(rows, rows + edges + 1);
  tables_.right.setZero(rows, 3);
  tables_.A.leftCols(rows).setIdentity();
  tables_.right.topRows<balance_rows>() = load;
  tables_.A.rightCols<1>().middleRows(balance_rows, drives).setConstant(-1);
  Index column = rows, limit = limits_;
  for (const ConeContact<2>& contact : hand.contacts) {
    const bool low = contact.lo > 0, high = std::isfinite(contact.hi);
    if (low) tables_.right(limit, 0) = -contact.lo;
    if (high) tables_.right(limit + (low ? 1 : 0), 0) = contact.hi;
    const auto add = [&](const Wrench<2>& wrench) {
      auto A = tables_.A.col(column++);
      A.head<balance_rows>() = wrench;
      for (Index a = 0; a < drives; ++a)
        for (const auto& moved : hand.drives[static_cast<std::size_t>(a)].moved)
          if (moved.finger == contact.finger) A[balance_rows + a] += moved.twist.dot(wrench);
      if (low) A[limit] = -1;
      if (high) A[limit + (low ? 1 : 0)] = 1;
    };
    if (contact.first == contact.last) {
      add(contact.normal);
    } else {
      const ConePart<2>& part = hand.parts[contact.first];
      for (const double side : {part.reach, -part.reach})
        add(contact.normal + side * part.G.col(0));
    }
    limit += (low ? 1 : 0) + (high ? 1 : 0);
  }
}

std::optional<GripPiece> GripProgram::at(double theta) {
  const Vector<3> posture(1, std::cos(theta), std::sin(theta));
  const auto solve_in = [&](auto simplex) -> std::optional<GripPiece> {
    using Solver = decltype(simplex);
    // From the basis of a posture nearby, or from none; then once more from the basis that was
    // found, without the rounding of the way to it.
    Solver way = simplex;
    const bool near = !basis_.empty() && way.go_to(basis_) && way.solve(posture);
    if (!near) {
      way = simplex;
      if (!way.solve(posture)) return {};
    }
    Solver found = simplex;
    if (!found.go_to(way.basis()) || !found.solve(posture)) return {};
    basis_ = found.basis();

    GripPiece piece;
    const Index rows = tables_.rows();
    std::vector<Affine> x(static_cast<std::size_t>(tables_.A.cols()), Affine::Zero());
    double largest = 1;
    for (Index row = 0; row < rows; ++row) {
      const Affine value = found.right(row).template cast<double>();
      x[static_cast<std::size_t>(basis_[static_cast<std::size_t>(row)])] = value;
      piece.conditions.push_back(value);
      if (found.is_forbidden(row)) piece.conditions.push_back(-value);
      largest = std::max(largest, value.cwiseAbs().maxCoeff());
    }
    piece.rounding = 1e-12 * largest;
    piece.F = x.back();
    for (Index row = 0; row < balance_rows; ++row)
      piece.y[row] = static_cast<double>(found.multiplier(row));
    for (Index row = balance_rows; row < limits_; ++row)
      piece.rates.push_back(std::max(0.0, static_cast<double>(-found.multiplier(row))));
    auto edge = static_cast<std::size_t>(rows);
    for (const ConeContact<2>& contact : hand_.contacts) {
      const bool smooth = contact.first == contact.last;
      const Affine& up = x[edge];
      const Affine down = smooth ? Affine(Affine::Zero()) : x[edge + 1];
      piece.normals.push_back(up + down);
      piece.tangentials.push_back(smooth ? down
                                         : Affine(hand_.parts[contact.first].reach * (up - down)));
      edge += smooth ? 1 : 2;
    }
    return piece;
  };
  if (auto piece = solve_in(Simplex<double>(tables_))) return piece;
  return solve_in(Simplex<Wide>(tables_));
}

}  // namespace poise::dual
