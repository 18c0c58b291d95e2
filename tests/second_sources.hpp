// Least contact forces found in other ways: slowly, in force space, in long double.
#pragma once

#include <Eigen/QR>
#include <limits>
#include <optional>

#include "checks.hpp"

namespace poise::test {

struct LeastForces {
  Real effort{std::numeric_limits<Real>::infinity()};
  std::vector<RealVector> forces;  ///< (normal, tangential)
};

/// Two contacts at two points have one internal force, along the line between them. What friction
/// and limits leave of it is an interval; the effort is a parabola over it. None if it is empty.
inline std::optional<LeastForces> clamped_internal_force(const Grasp<2>& grasp,
                                                         const RealWrench& w) {
  const Contact<2>&a = grasp.contacts()[0], &b = grasp.contacts()[1];
  const RealVector line = (b.position - a.position).cast<Real>();
  const Real distance = line.norm(), weight = grasp.size();
  const RealVector along = line / distance, across(-along.y(), along.x());
  const Real moment = w[2] - cross(a.position.cast<Real>(), w.head<2>());
  const RealVector particular_b = moment / distance * across;
  const RealVector particular[2] = {w.head<2>() - particular_b, particular_b};
  const RealVector internal[2] = {along, -along};

  Real least = -std::numeric_limits<Real>::infinity(), most = -least, slope = 0, curvature = 0;
  bool empty = false;
  const auto keep = [&](Real value, Real rate) {  // value + rate alpha >= 0
    if (std::abs(rate) <= 1e-14L) {
      empty = empty || value < -1e-14L * weight;
    } else if (rate > 0) {
      least = std::max(least, -value / rate);
    } else {
      most = std::min(most, -value / rate);
    }
  };
  for (std::size_t i = 0; i < 2; ++i) {
    const Contact<2>& contact = grasp.contacts()[i];
    const RealVector f = in_contact_frame(contact, particular[i]);
    const RealVector d = in_contact_frame(contact, internal[i]);
    const Real mu = contact.friction;
    keep(mu * f.x() - f.y(), mu * d.x() - d.y());
    keep(mu * f.x() + f.y(), mu * d.x() + d.y());
    keep(f.x() - contact.min_normal, d.x());
    if (std::isfinite(contact.max_normal)) keep(contact.max_normal - f.x(), -d.x());
    slope += particular[i].dot(internal[i]) / contact.share;
    curvature += 1 / Real{contact.share};
  }
  if (empty || least > most + balance_tolerance * (weight + std::abs(least))) return {};
  const Real alpha = std::max(least, std::min(most, -slope / curvature));
  LeastForces answer;
  for (std::size_t i = 0; i < 2; ++i)
    answer.forces.push_back(
        in_contact_frame(grasp.contacts()[i], particular[i] + alpha * internal[i]));
  answer.effort = effort_of(grasp, answer.forces);
  return answer;
}

/// The plane, line or point in which a face of a contact's cone lies: offset + span x.
struct FlatFace {
  RealVector offset{RealVector::Zero()};
  Eigen::Matrix<Real, 2, Eigen::Dynamic> span;
};

inline std::vector<FlatFace> faces_of(const Contact<2>& contact) {
  const Real mu = contact.friction;
  std::vector<FlatFace> faces(1);
  faces[0].span = Eigen::Matrix<Real, 2, 2>::Identity();
  for (const Real slope : {mu, -mu}) {
    FlatFace edge;
    edge.span = RealVector(1, slope);
    faces.push_back(edge);
  }
  for (const Real limit : {Real{contact.min_normal}, Real{contact.max_normal}}) {
    if (!std::isfinite(limit)) continue;
    FlatFace side;
    side.offset = {limit, 0};
    side.span = RealVector(0, 1);
    if (limit > 0) faces.push_back(side);
    for (const Real slope : {mu, -mu}) {
      FlatFace corner;
      corner.offset = {limit, slope * limit};
      corner.span.resize(2, 0);
      if (limit > 0 || slope == mu) faces.push_back(corner);
    }
  }
  return faces;
}

/// Tries every choice of faces: on each the least forces that balance w; the feasible ones compete.
class EveryFace {
 public:
  EveryFace(const Grasp<2>& grasp, const RealWrench& w) : grasp_(grasp), w_(w) {
    for (const Contact<2>& contact : grasp.contacts()) faces_.push_back(faces_of(contact));
    chosen_.resize(faces_.size());
    choose(0);
  }

  std::optional<LeastForces> answer() const {
    if (best_.forces.empty()) return {};
    return best_;
  }

 private:
  void choose(std::size_t contact) {
    if (contact == faces_.size()) return solve();
    for (const FlatFace& face : faces_[contact]) {
      chosen_[contact] = &face;
      choose(contact + 1);
    }
  }

  void solve() {
    const RealVector com = grasp_.center().cast<Real>();
    const Real length = grasp_.radius() > 0 ? grasp_.radius() : 1;
    const auto wrench = [&](std::size_t i, const RealVector& force) {
      const Contact<2>& contact = grasp_.contacts()[i];
      const RealVector f = in_object_frame(contact, force);
      return RealWrench(f.x(), f.y(), cross(contact.position.cast<Real>() - com, f) / length);
    };
    Eigen::Index unknowns = 0;
    for (const FlatFace* face : chosen_) unknowns += face->span.cols();
    Eigen::Matrix<Real, 3, Eigen::Dynamic> A(3, unknowns);
    RealWrench rest(w_[0], w_[1], (w_[2] - cross(com, w_.head<2>())) / length);
    Eigen::Index column = 0;
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      rest -= wrench(i, chosen_[i]->offset);
      for (Eigen::Index k = 0; k < chosen_[i]->span.cols(); ++k)
        A.col(column++) = wrench(i, scale(i, k) * chosen_[i]->span.col(k));
    }
    Eigen::Matrix<Real, Eigen::Dynamic, 1> x(unknowns);
    if (unknowns > 0) {
      Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix<Real, 3, Eigen::Dynamic>> cod;
      cod.setThreshold(1e-13L);
      cod.compute(A);
      x = cod.solve(rest);
    }
    LeastForces trial;
    column = 0;
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      RealVector force = chosen_[i]->offset;
      for (Eigen::Index k = 0; k < chosen_[i]->span.cols(); ++k)
        force += x[column++] * scale(i, k) * chosen_[i]->span.col(k);
      trial.forces.push_back(force);
    }
    trial.effort = effort_of(grasp_, trial.forces);
    const Real weight = grasp_.size();
    const Real tolerance = balance_tolerance * (weight + std::sqrt(trial.effort));
    if (trial.effort >= best_.effort) return;
    if (imbalance(grasp_, w_, trial.forces) * weight > tolerance) return;
    for (std::size_t i = 0; i < chosen_.size(); ++i)
      if (outside(grasp_.contacts()[i], trial.forces[i]) > tolerance) return;
    best_ = std::move(trial);
  }

  /// Makes an unknown count as its square in the effort.
  Real scale(std::size_t i, Eigen::Index k) const {
    return std::sqrt(Real{grasp_.contacts()[i].share}) / chosen_[i]->span.col(k).norm();
  }

  const Grasp<2>& grasp_;
  RealWrench w_;
  std::vector<std::vector<FlatFace>> faces_;
  std::vector<const FlatFace*> chosen_;
  LeastForces best_;
};

/// An answer of a second source, and whether postures nearby agree on there being one: within
/// rounding of the limit of holding there is nothing to compare.
template <class Source>
std::optional<std::optional<LeastForces>> decided(const Grasp<2>& grasp, double theta,
                                                  const Source& source) {
  const auto at = [&](double angle) {
    std::optional<LeastForces> answer = source(grasp, load_at(grasp, angle));
    if (answer && answer->effort > squared_cap(grasp, 1e6)) answer.reset();
    return answer;
  };
  std::optional<LeastForces> answer = at(theta);
  for (const double nearby : {-1e-7, 1e-7})
    if (at(theta + nearby).has_value() != answer.has_value()) return {};
  return answer;
}

}  // namespace poise::test
