// The convex hull of points, one added after the other. Not installed.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "poise/wrench.hpp"

namespace poise {

/// As the half-spaces n . x <= b of its facets, each with Dim corners.
template <int Dim>
class Hull {
 public:
  struct Facet {
    std::array<std::size_t, Dim> corners;  ///< rising
    Vector<Dim> n;                         ///< of length 1, outwards
    double b;
  };

  /// Of the corners of a simplex; without facets where that is flat.
  explicit Hull(const std::array<Vector<Dim>, Dim + 1>& simplex)
      : points_(simplex.begin(), simplex.end()) {
    for (const Vector<Dim>& x : simplex) inside_ += x / (Dim + 1);
    for (std::size_t without = 0; without <= Dim; ++without) {
      std::array<std::size_t, Dim> corners;
      for (std::size_t k = 0, i = 0; i <= Dim; ++i)
        if (i != without) corners[k++] = i;
      if (const auto facet = facet_of(corners)) facets_.push_back(*facet);
    }
    if (facets_.size() <= Dim) facets_.clear();
  }

  /// False, and unchanged: x is inside, or rounding makes it ambiguous.
  bool add(const Vector<Dim>& x) {
    const auto is_seen = [&](const Facet& facet) { return facet.n.dot(x) > facet.b + rounding(x); };
    std::vector<Ridge> ridges;
    for (const Facet& facet : facets_)
      if (is_seen(facet))
        for (std::size_t without = 0; without < Dim; ++without)
          ridges.push_back(ridge_of(facet, without));
    if (ridges.empty()) return false;
    std::sort(ridges.begin(), ridges.end());
    points_.push_back(x);
    std::vector<Facet> fan;
    for (std::size_t k = 0; k < ridges.size(); ++k) {
      if (k + 1 < ridges.size() && ridges[k] == ridges[k + 1]) {  // between two that are seen
        ++k;
        continue;
      }
      std::array<std::size_t, Dim> corners;
      std::copy(ridges[k].begin(), ridges[k].end(), corners.begin());
      corners.back() = points_.size() - 1;
      const auto facet = facet_of(corners);
      if (!facet) {
        points_.pop_back();
        return false;
      }
      fan.push_back(*facet);
    }
    std::erase_if(facets_, is_seen);
    facets_.insert(facets_.end(), fan.begin(), fan.end());
    return true;
  }

  const std::vector<Facet>& facets() const { return facets_; }
  const Vector<Dim>& operator[](std::size_t point) const { return points_[point]; }
  /// The points that are corners of it.
  std::vector<std::size_t> corners() const {
    std::vector<char> needed(points_.size(), 0);
    for (const Facet& facet : facets_)
      for (const std::size_t i : facet.corners) needed[i] = 1;
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (needed[i] != 0) kept.push_back(i);
    return kept;
  }

  /// Draws a corner nearer to a point inside, by a part of the way. Facets follow, which then lie
  /// inside of the convex hull: between each of them and the point all is held. False: that has
  /// no size any more.
  bool draw(std::size_t corner, const Vector<Dim>& towards, double part) {
    inside_ = towards;
    points_[corner] += part * (towards - points_[corner]);
    for (Facet& facet : facets_) {
      if (std::find(facet.corners.begin(), facet.corners.end(), corner) == facet.corners.end())
        continue;
      const auto moved = facet_of(facet.corners);
      if (!moved) return false;
      facet = *moved;
    }
    return true;
  }

 private:
  using Ridge = std::array<std::size_t, Dim - 1>;

  double rounding(const Vector<Dim>& x) const { return 1e-13 * (x - inside_).norm(); }

  static Ridge ridge_of(const Facet& facet, std::size_t without) {
    Ridge ridge;
    for (std::size_t k = 0, i = 0; i < Dim; ++i)
      if (i != without) ridge[k++] = facet.corners[i];
    return ridge;
  }

  /// None where it has no size, or the inside is not behind it.
  std::optional<Facet> facet_of(const std::array<std::size_t, Dim>& corners) const {
    const Vector<Dim>& a = points_[corners[0]];
    Vector<Dim> n;
    const Vector<Dim> along = points_[corners[1]] - a;
    double size = along.norm();
    if constexpr (Dim == 2) {
      n = {along.y(), -along.x()};
    } else {
      const Vector<3> beside = points_[corners[2]] - a;
      n = along.cross(beside);
      size *= beside.norm();
    }
    const double length = n.norm();
    if (!(length > 1e-12 * size)) return {};
    n /= length;
    if (n.dot(inside_ - a) > 0) n = -n;
    if (!(n.dot(a - inside_) > rounding(a))) return {};
    double b = n.dot(a);  // the least of the corners' is safe
    for (const std::size_t i : corners) b = std::min(b, n.dot(points_[i]));
    return Facet{corners, n, b};
  }

  std::vector<Vector<Dim>> points_;
  Vector<Dim> inside_ = Vector<Dim>::Zero();
  std::vector<Facet> facets_;
};

}  // namespace poise
