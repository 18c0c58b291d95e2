#include "verify/manner.hpp"

#include <Eigen/QR>
#include <cmath>
#include <limits>

namespace poise::verify {
namespace {

/// The distance of b from the cone that the columns of A span, by the method of Lawson and Hanson:
/// columns are used, or not, until none that is not could take b nearer.
Real distance_to_cone(const Mat& A, const Vec& b) {
  constexpr Real nothing = 1e-17L;
  Vec x = Vec::Zero(A.cols()), left = b;
  std::vector<Eigen::Index> used;
  const auto solve = [&] {
    const Mat some = A(Eigen::all, used);
    return Vec(some.colPivHouseholderQr().solve(b));
  };
  for (Eigen::Index round = 0; round < 10 * A.cols(); ++round) {
    Vec gain = A.transpose() * left;
    for (const Eigen::Index k : used) gain[k] = 0;
    Eigen::Index best = 0;
    if (!(gain.maxCoeff(&best) > nothing)) break;
    used.push_back(best);
    Vec wanted = solve();
    while (!used.empty() && wanted.minCoeff() <= 0) {
      // Go towards it as far as all stay above 0, and leave out those that are there.
      Real part = 1;
      for (std::size_t k = 0; k < used.size(); ++k) {
        const Real now = x[used[k]], then = wanted[static_cast<Eigen::Index>(k)];
        if (then <= 0) part = std::min(part, now > 0 ? now / (now - then) : 0);
      }
      std::vector<Eigen::Index> kept;
      for (std::size_t k = 0; k < used.size(); ++k) {
        Real& now = x[used[k]];
        const Real then = wanted[static_cast<Eigen::Index>(k)];
        now += part * (then - now);
        if (then <= 0 && now <= nothing)
          now = 0;
        else
          kept.push_back(used[k]);
      }
      used = kept;
      if (!used.empty()) wanted = solve();
    }
    x.setZero();
    for (std::size_t k = 0; k < used.size(); ++k) x[used[k]] = wanted[static_cast<Eigen::Index>(k)];
    const Real before = left.norm();
    left = b - A * x;
    if (!(left.norm() < before)) break;
  }
  return left.norm();
}

/// Where the normal force of a contact may act: of a pad in the rectangle between these.
std::vector<Vec> places(const RealContact& contact) {
  if (!contact.pad) return {contact.position};
  const auto& tilts = contact.pad->tilts;
  std::vector<Vec> corners;
  for (const Real a : {-1, 1})
    for (const Real b : {-1, 1})  // about one axis the pressure moves along the other
      corners.emplace_back(contact.middle() + a * tilts[0].reach * tilts[1].axis +
                           b * tilts[1].reach * tilts[0].axis);
  return corners;
}

/// What normal forces must give, the first rows the load [weights], and what each can give.
struct Frictionless {
  Mat A;
  Vec b;

  /// Adds an unknown that gives `gives` in the first rows.
  void add_unknown(const Vec& gives) {
    A.conservativeResizeLike(Mat::Zero(A.rows(), A.cols() + 1));
    A.rightCols(1).topRows(gives.size()) = gives;
  }
  /// Adds that a sum of what is known so far, less how far it is away, is `right`.
  void add_limit(const Vec& sum, Real right, Real away) {
    add_unknown(Vec::Zero(A.rows()));
    A.conservativeResizeLike(Mat::Zero(A.rows() + 1, A.cols()));
    A.bottomRows(1).leftCols(sum.size()) = sum.transpose();
    A(A.rows() - 1, A.cols() - 1) = away;
    b.conservativeResize(A.rows());
    b[A.rows() - 1] = right;
  }
};

/// Moments are about the com, over the distance of the farthest contact. Unknowns are the normal
/// forces, and how far each is from its limits, also of the drives if they count.
Frictionless frictionless(const RealGrasp& grasp, const RealLoad& load, const Vec& up,
                          bool with_drives) {
  const auto scaled = [&](const Vec& w) {
    Vec result = w - wrench(Vec(w.head(grasp.dim)), load.com);
    result.tail(w.size() - grasp.dim) /= load.radius > 0 ? load.radius : 1;
    result.head(grasp.dim) = w.head(grasp.dim);
    return result;
  };
  const Vec w = scaled(wrench(load, up)) / load.size();
  Frictionless problem{Mat::Zero(w.size(), 0), w};
  Mat efforts = Mat::Zero(static_cast<Eigen::Index>(grasp.drives.size()), 0);  // of the unknowns
  for (const RealContact& contact : grasp.contacts) {
    const Eigen::Index first = problem.A.cols();
    for (const Vec& place : places(contact)) {
      const Vec pressing = wrench(contact.normal, place);
      problem.add_unknown(scaled(pressing));
      efforts.conservativeResizeLike(Mat::Zero(efforts.rows(), problem.A.cols()));
      for (std::size_t a = 0; a < grasp.drives.size(); ++a)
        for (const RealDrive::Moved& moved : grasp.drives[a].moves)
          if (moved.finger == contact.finger)
            efforts(static_cast<Eigen::Index>(a), problem.A.cols() - 1) +=
                moved.twist.dot(pressing);
    }
    Vec normal = Vec::Zero(problem.A.cols());
    normal.tail(problem.A.cols() - first).setOnes();
    if (contact.least > 0) problem.add_limit(normal, contact.least / load.size(), -1);
    if (std::isfinite(contact.most)) problem.add_limit(normal, contact.most / load.size(), 1);
  }
  for (std::size_t a = 0; a < grasp.drives.size() && with_drives; ++a)
    if (const Real max = grasp.drives[a].max; std::isfinite(max))
      problem.add_limit(efforts.row(static_cast<Eigen::Index>(a)).transpose() * (load.size() / max),
                        1, 1);
  return problem;
}

}  // namespace

Friction friction_for(const RealGrasp& grasp, const RealLoad& load, const Vec& up) {
  constexpr Real missing = 1e-9L, inside = 1e-6L, nothing = 1e-13L;
  const Frictionless free = frictionless(grasp, load, up, false);
  if (distance_to_cone(free.A, free.b) > missing) return Friction::needed;
  // What drives with a max would have to give without friction is open: needless is what it is
  // within them, too.
  const auto [A, b] = frictionless(grasp, load, up, true);
  for (Eigen::Index k = 0; k < (grasp.dim == 2 ? 3 : 6); ++k)
    for (const Real sign : {-1, 1})
      if (distance_to_cone(A, b + sign * inside * Vec::Unit(b.size(), k)) > nothing)
        return Friction::unclear;
  return Friction::needless;
}

}  // namespace poise::verify
