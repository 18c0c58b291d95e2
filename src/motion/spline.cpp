#include "motion/spline.hpp"

namespace poise {
namespace {

using Row = Eigen::RowVectorXd;

/// The parabola through three points, or the line through two.
SplineDerivatives of_few(const std::vector<double>& t, const Eigen::MatrixXd& points) {
  const Eigen::Index n = points.rows();
  SplineDerivatives result{Eigen::MatrixXd::Zero(n, points.cols()),
                           Eigen::MatrixXd::Zero(n, points.cols())};
  if (n < 2) return result;
  const Row first = (points.row(1) - points.row(0)) / (t[1] - t[0]);
  if (n == 2) {
    result.first.rowwise() = first;
    return result;
  }
  const Row next = (points.row(2) - points.row(1)) / (t[2] - t[1]);
  const Row second = 2 * (next - first) / (t[2] - t[0]);
  result.second.rowwise() = second;
  const Row start = first - (t[1] - t[0]) / 2 * second;
  for (Eigen::Index k = 0; k < 3; ++k)
    result.first.row(k) = start + (t[static_cast<std::size_t>(k)] - t[0]) * second;
  return result;
}

/// The second derivatives m of the spline: for every inner point
///   h_(k-1) m_(k-1) + 2 (h_(k-1) + h_k) m_k + h_k m_(k+1) = 6 (slope_k - slope_(k-1)),
/// with the first and last given by the third derivative's continuity next to them.
Eigen::MatrixXd second_derivatives(const Eigen::VectorXd& h, const Eigen::MatrixXd& slopes) {
  const Eigen::Index n = h.size() + 1, last = n - 1;
  Eigen::MatrixXd m(n, slopes.cols());
  Eigen::VectorXd diagonal(n), above(n);
  for (Eigen::Index k = 1; k < last; ++k) {
    double below = h[k - 1];
    diagonal[k] = 2 * (h[k - 1] + h[k]);
    above[k] = h[k];
    m.row(k) = 6 * (slopes.row(k) - slopes.row(k - 1));
    if (k == 1) {  // m_0 = m_1 + (m_1 - m_2) h_0 / h_1
      diagonal[k] += h[0] + h[0] * h[0] / h[1];
      above[k] -= h[0] * h[0] / h[1];
      below = 0;
    }
    if (k == last - 1) {
      const double ratio = h[last - 1] / h[last - 2];
      diagonal[k] += h[last - 1] * (1 + ratio);
      below -= h[last - 1] * ratio;
      above[k] = 0;
    }
    if (k > 1) {
      const double factor = below / diagonal[k - 1];
      diagonal[k] -= factor * above[k - 1];
      m.row(k) -= factor * m.row(k - 1);
    }
  }
  for (Eigen::Index k = last - 1; k >= 1; --k) {
    if (k < last - 1) m.row(k) -= above[k] * m.row(k + 1);
    m.row(k) /= diagonal[k];
  }
  m.row(0) = m.row(1) + h[0] / h[1] * (m.row(1) - m.row(2));
  m.row(last) = m.row(last - 1) + h[last - 1] / h[last - 2] * (m.row(last - 1) - m.row(last - 2));
  return m;
}

}  // namespace

SplineDerivatives spline(const std::vector<double>& times, const Eigen::MatrixXd& points) {
  const Eigen::Index n = points.rows();
  if (n < 4) return of_few(times, points);
  Eigen::VectorXd h(n - 1);
  Eigen::MatrixXd slopes(n - 1, points.cols());
  for (Eigen::Index k = 0; k + 1 < n; ++k) {
    h[k] = times[static_cast<std::size_t>(k) + 1] - times[static_cast<std::size_t>(k)];
    slopes.row(k) = (points.row(k + 1) - points.row(k)) / h[k];
  }
  SplineDerivatives result{Eigen::MatrixXd(n, points.cols()), second_derivatives(h, slopes)};
  const Eigen::MatrixXd& m = result.second;
  for (Eigen::Index k = 0; k + 1 < n; ++k)
    result.first.row(k) = slopes.row(k) - h[k] / 6 * (2 * m.row(k) + m.row(k + 1));
  result.first.row(n - 1) = slopes.row(n - 2) + h[n - 2] / 6 * (m.row(n - 2) + 2 * m.row(n - 1));
  return result;
}

}  // namespace poise
