#include "plane/arc.hpp"

#include <algorithm>
#include <type_traits>

#include "dual/twist.hpp"

namespace poise {
namespace {

/// A few units in the last place of 1; what is as good as singular.
template <class T>
constexpr double rounding_of = std::is_same_v<T, double> ? 4e-15 : 1e-30;
template <class T>
constexpr double singular = std::is_same_v<T, double> ? 1e-6 : 1e-28;
/// A turn about the com is felt by no contact where this is all that it adds.
constexpr double unfelt = 1e-26;
/// Of the largest force, and of the largest part of y: what rounding may make of 0.
constexpr double rounding_of_faces = 1e-12;

/// By Cramer's rule, from the upper triangle. False: M is as good as singular.
template <class T>
bool invert(const dual::Square<2, T>& M, dual::Square<2, T>& inverse) {
  inverse << M(1, 1) * M(2, 2) - M(1, 2) * M(1, 2), M(0, 2) * M(1, 2) - M(0, 1) * M(2, 2),
      M(0, 1) * M(1, 2) - M(0, 2) * M(1, 1), T(0), M(0, 0) * M(2, 2) - M(0, 2) * M(0, 2),
      M(0, 1) * M(0, 2) - M(0, 0) * M(1, 2), T(0), T(0), M(0, 0) * M(1, 1) - M(0, 1) * M(0, 1);
  const T determinant = M(0, 0) * inverse(0, 0) + M(0, 1) * inverse(0, 1) + M(0, 2) * inverse(0, 2);
  const T upright = M(0, 0) * M(1, 1), plane = inverse(2, 2);
  if (!(plane > singular<T> * upright) || !(determinant > singular<T> * plane * M(2, 2)))
    return false;
  inverse(1, 0) = inverse(0, 1);
  inverse(2, 0) = inverse(0, 2);
  inverse(2, 1) = inverse(1, 2);
  inverse *= 1 / determinant;
  return true;
}

}  // namespace

LoadCurve load_curve(const ScaledHand<2>& hand, double weight, const Load<2>& load) {
  const Load<2> turning{.weight = load.turning(), .com = load.com};
  LoadCurve curve;
  curve << scaled_wrench(hand, weight, load.still()),
      scaled_load<2>(hand, weight, turning, Vector<2>::UnitY()),
      scaled_load<2>(hand, weight, turning, Vector<2>::UnitX());
  return curve;
}

template <class T>
ArcSolver<T>::ArcSolver(const Cones<2, T>& cones, const LoadCurve& load)
    : limited_(cones.limited || !load.col(0).isZero(0)),
      load_(load.cast<T>()),
      contacts_(cones.size) {
  for (std::size_t i = 0; i < cones.size; ++i) {
    const ContactLane<2, T>& c = cones.lanes[i / lane_size_of<T>];
    const std::size_t k = i % lane_size_of<T>;
    Contact& contact = contacts_[i];
    contact.G = dual::columns<T>(cones, i);
    contact.mu = element(c.mu, k);
    contact.edge = element(c.edge, k);
    contact.lo = cones.scaled(element(c.lo, k));
    contact.hi = cones.scaled(element(c.hi, k));
  }
}

template <class T>
bool ArcSolver<T>::solve(const dual::Point<2, T>& point, Reach& reach, Arc& arc) {
  dual::Square<2, T> M = dual::Square<2, T>::Zero();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    Contact& contact = contacts_[i];
    contact.face = dual::face(contact.mu, contact.edge, contact.lo, contact.hi, point.z(i));
    M += contact.G * contact.face.P * contact.G.transpose();
  }
  // A turn about the com that no contact feels has no say in the forces (2 x 2 is left of M).
  const bool free_turn = M(2, 2) <= unfelt * M.trace();
  if (free_turn) {
    M.row(2).setZero();
    M.col(2).setZero();
    M(2, 2) = M.trace();
  }
  dual::Square<2, T> inverse;
  if (!invert(M, inverse)) return false;

  // Of the constant, which is 0 without force limits, and of cos theta and sin theta.
  Affine<3> Y = Affine<3>::Zero();
  for (Contact& contact : contacts_) {
    contact.F.setZero();
    contact.Z.setZero();
  }
  T largest_force = 1;
  if (limited_) {
    const dual::Screw<2, T> fixed = load_.col(0);
    dual::Screw<2, T> residual = fixed;
    for (Contact& contact : contacts_) {
      contact.F.col(0) = contact.face.f0;
      residual -= contact.G * contact.face.f0;
    }
    balance<0, 1>(inverse, fixed, residual, free_turn, Y, largest_force);
  }
  const Eigen::Matrix<T, 3, 2> load = load_.template rightCols<2>();
  balance<1, 2>(inverse, load, load, free_turn, Y, largest_force);
  if (free_turn) {
    Y.row(2) = turn_at(reach, Y);
    for (Contact& contact : contacts_) contact.Z = contact.G.transpose() * Y;
  }

  const T largest_y = Y.cwiseAbs().maxCoeff();
  for (const Contact& contact : contacts_)
    for_each_condition(contact, [&](const Row& g, Of of) {
      const T& largest = of == Of::force ? largest_force : largest_y;
      reach.keep(g.template cast<double>(), rounding_of_faces * static_cast<double>(largest));
    });
  arc.value = effort();
  for (int k = 0; k < 3; ++k)
    arc.y[static_cast<std::size_t>(k)] = {
        static_cast<double>(Y(k, 0)), static_cast<double>(Y(k, 1)), static_cast<double>(Y(k, 2))};
  return true;
}

/// Of the arc, from its forces [weights^2].
template <class T>
Harmonic2 ArcSolver<T>::effort() const {
  Harmonic2 V;
  for (const Contact& contact : contacts_) {
    const Eigen::Matrix<double, 2, 3> F = contact.F.template cast<double>();
    const auto product = [&](int j, int k) { return F.col(j).dot(F.col(k)); };
    const double cos_cos = product(1, 1), sin_sin = product(2, 2);
    V.c0 += (cos_cos + sin_sin) / 2;
    V.cos2 += (cos_cos - sin_sin) / 2;
    V.sin2 += product(1, 2);
    if (!limited_) continue;
    V.c0 += product(0, 0);
    V.cos1 += 2 * product(0, 1);
    V.sin1 += 2 * product(0, 2);
  }
  return V;
}

/// Balances `load`, of which `residual` is left, by the columns of y and of the forces from First
/// on, refined in the forces: see dual.cpp, polish.
template <class T>
template <int First, int Columns>
void ArcSolver<T>::balance(const dual::Square<2, T>& inverse,
                           const Eigen::Matrix<T, 3, Columns>& load,
                           Eigen::Matrix<T, 3, Columns> residual, bool free_turn, Affine<3>& Y,
                           T& largest_force) {
  for (int round = 0; round < 4; ++round) {
    if (free_turn) residual.row(2).setZero();
    if (residual.cwiseAbs().maxCoeff() <= rounding_of<T> * largest_force) break;
    const Eigen::Matrix<T, 3, Columns> dY = inverse * residual;
    Y.template middleCols<Columns>(First) += dY;
    residual = load;
    for (Contact& contact : contacts_) {
      const Eigen::Matrix<T, 2, Columns> dZ = contact.G.transpose() * dY;
      contact.Z.template middleCols<Columns>(First) += dZ;
      auto F = contact.F.template middleCols<Columns>(First);
      F += contact.face.P * dZ;
      // Exactly on the edge: what rounding adds beside it would be taken for a balance.
      if (contact.face.edge) F.row(1) = contact.face.sign * contact.mu * F.row(0);
      residual -= contact.G * F;
      largest_force = std::max<T>(largest_force, F.cwiseAbs().maxCoeff());
    }
  }
}

/// Calls f(g, of) for each g(theta) >= 0 that keeps a contact on its face: that the force
/// stays on it, and that z stays over it.
template <class T>
template <class Function>
void ArcSolver<T>::for_each_condition(const Contact& contact, const Function& f) {
  const auto& [G, mu, edge, lo, hi, face, F, Z] = contact;
  const bool free = !face.at_lo && !face.at_hi;
  const auto constant = [](const T& value) { return Row(value, 0, 0); };
  const Row n = F.row(0), t = F.row(1), zn = Z.row(0), side = T(face.sign) * Z.row(1);
  const Row along = face.edge ? Row((zn + mu * side) * edge) : zn;
  if (face.edge && face.at_lo && lo == 0) {  // the apex
    f(-along, Of::motion);
    if (mu > 0) f(mu * side - zn, Of::motion);
    return;
  }
  if (face.at_lo) f(constant(lo) - along, Of::motion);
  if (face.at_hi) f(along - constant(hi), Of::motion);
  if (free && (face.edge || lo > 0)) f(n - constant(lo), Of::force);
  if (free && hi < std::numeric_limits<double>::max()) f(constant(hi) - n, Of::force);
  if (face.edge && mu > 0) f(side - mu * (free ? zn : n), Of::motion);
  if (!face.edge) {
    f(mu * n - t, Of::force);
    f(mu * n + t, Of::force);
  }
}

/// The angular velocity that no loaded contact feels: 0, or what the others allow at the posture,
/// at the end of their range.
template <class T>
typename ArcSolver<T>::Row ArcSolver<T>::turn_at(const Reach& reach, const Affine<3>& Y) const {
  const Eigen::Matrix<T, 3, 1> here(1, reach.cosine, reach.sine);
  Affine<3> still = Y, turning = Y;
  still.row(2).setZero();
  turning.row(2) << 1, 0, 0;
  T least = -std::numeric_limits<double>::infinity(), most = -least;
  Row at_least = Row::Zero(), at_most = Row::Zero();
  for (const Contact& contact : contacts_) {
    const auto conditions = [&](const Affine<3>& twist) {
      Contact moved = contact;
      moved.Z = contact.G.transpose() * twist;
      std::vector<Row> all;
      for_each_condition(moved, [&](const Row& g, Of of) {
        if (of == Of::motion) all.push_back(g);
      });
      return all;
    };
    const std::vector<Row> base = conditions(still), both = conditions(turning);
    for (std::size_t k = 0; k < base.size(); ++k) {
      const T rate = both[k][0] - base[k][0];
      using std::abs;
      if (abs(rate) <= 1e-12) continue;
      const Row end = -base[k] / rate;
      const T omega = end.dot(here.transpose());
      if (rate > 0 && omega > least) {
        least = omega;
        at_least = end;
      } else if (rate < 0 && omega < most) {
        most = omega;
        at_most = end;
      }
    }
  }
  if (least > 0) return at_least;
  if (most < 0) return at_most;
  return Row::Zero();
}

template <class T>
ArcState ArcSolver<T>::state(std::size_t i) const {
  const Contact& contact = contacts_[i];
  const Row n = contact.F.row(0), t = contact.F.row(1), most = contact.mu * n;
  const auto vanishes = [](const Row& g) { return g.cwiseAbs().maxCoeff() <= 1e-9; };
  const auto at = [&](const T& limit) {
    return limit < std::numeric_limits<double>::max() && vanishes(n - Row(limit, 0, 0));
  };
  const bool slips = contact.face.edge || vanishes(most - t) || vanishes(most + t);
  return {vanishes(n) ? ContactState::unloaded
          : slips     ? ContactState::slipping
                      : ContactState::sticking,
          at(contact.hi)                     ? ForceLimit::max
          : contact.lo > 0 && at(contact.lo) ? ForceLimit::min
                                             : ForceLimit::none};
}

template class ArcSolver<double>;
template class ArcSolver<Wide>;

}  // namespace poise
