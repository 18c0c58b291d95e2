// What can be supplied, from both sides: the hull of what was found to be held, and half-spaces
// that leave all that can be. Not installed.
#pragma once

#include <vector>

#include "shake/hull.hpp"
#include "shake/supply.hpp"

namespace poise {

/// What is to lie in the body: the ball of a radius about a point. Reaches are radii.
template <int Dim>
struct Ball {
  Vector<Dim> center;

  /// The largest that lies in n . z <= b.
  double reach(const Vector<Dim>& n, double b) const { return b - n.dot(center); }
  /// Where it touches the plane.
  Vector<Dim> touching(const Vector<Dim>& n, double b) const { return center + reach(n, b) * n; }
};

/// The part of a sphere about 0 within an angle of a point of it. Reaches are angles, infinite
/// where the whole sphere lies there.
template <int Dim>
struct Cap {
  Vector<Dim> center;

  double reach(const Vector<Dim>& n, double b) const;
  Vector<Dim> touching(const Vector<Dim>& n, double b) const;
  /// The point of the sphere this far from the center, towards n.
  Vector<Dim> at(const Vector<Dim>& n, double angle) const;
};

/// When to be content.
struct Wanted {
  double gap;      ///< relative
  double little;   ///< a difference in reach that does not matter
  double far;      ///< reaches beyond are as good as infinite
  double horizon;  ///< how far from the center to look at all
  double enough;   ///< no longer reach is of interest
  double needed;   ///< nor any that is not longer than this
  int max_holds;
};

template <int Dim>
class Body {
 public:
  /// @param known  cuts of the supply from elsewhere
  Body(const Supply<Dim>& supply, const Vector<Dim>& inside, std::vector<SupplyCut<Dim>> known = {})
      : supply_(supply), inside_(inside), cuts_(std::move(known)) {}

  /// The greatest reach of a ball or cap about the point inside, from both sides.
  template <class Goal>
  void measure(const Goal& goal, const Wanted& wanted);
  /// Only whether the inside is held: then the reach is infinite.
  void only_inside();

  bool holdable{false};
  double reach{0}, bound{0};
  SupplyCut<Dim> cut;  ///< that proves the bound, or that the inside is not held
  bool proven{true};
  int holds{0};

  const std::vector<SupplyCut<Dim>>& cuts() const { return cuts_; }
  /// Of what is held, where it has a size.
  const std::optional<Hull<Dim>>& hull() const { return hull_; }

 private:
  /// Points that are held: as far towards what was asked as is known, and one beside that line.
  struct Held {
    std::optional<Vector<Dim>> on_line, beside;
  };
  /// Asks, and remembers the cut.
  Held look(const Vector<Dim>& z);
  double end_of(const Vector<Dim>& direction, double far) const;
  std::optional<Vector<Dim>> look_along(const Vector<Dim>& direction, double far);
  bool span(double far);
  template <class Goal>
  void take_bound(const Goal& goal);
  template <class Goal>
  bool extend(const Goal& goal, const typename Hull<Dim>::Facet& facet, const Wanted& wanted);

  const Supply<Dim>& supply_;
  Vector<Dim> inside_;
  double part_inside_{0}, pull_{0};
  std::vector<SupplyCut<Dim>> cuts_;
  std::size_t taken_{0};  ///< cuts that the bound knows
  std::optional<Hull<Dim>> hull_;
};

}  // namespace poise
