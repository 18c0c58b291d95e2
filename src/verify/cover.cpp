#include <algorithm>
#include <cmath>
#include <limits>

#include "verify/checks.hpp"
#include "verify/curve.hpp"

namespace poise::verify {
namespace {

constexpr Real infinity = std::numeric_limits<Real>::infinity();

/// What y and rates of limited drives prove of the effort in all postures, times harmonics(theta),
/// less `balance` times what y moves the com by.
Vec3 proof(const RealGrasp& grasp, const Vec& y, const std::vector<Real>& rates, Real balance) {
  const RealLoad& load = grasp.loads.front();
  Vec3 g = 2 * load_matrix(load).transpose() * y.head<3>();
  g[0] += bound(grasp, Vec::Zero(3), y, rates) - 2 * balance * imbalance_power(load, y);
  return g;
}

Path unholdable_path(std::size_t k) { return (Path() / "unholdable_arcs")[k]; }

/// An arc or an unholdable one.
struct Piece {
  Path place;
  Real from, to;
  Vec3 proof_from, proof_to;  ///< what its ends prove, times harmonics(theta)
  bool arc;
};

/// Nothing is left of it but its ends, which rounding puts somewhere: it proves nothing.
bool is_narrow(const UnholdableClaim& arc) { return arc.to - arc.from <= 2 * end_slack; }

/// The grasp with the load that cannot be held.
const RealGrasp& load_of(const EachLoad& grasps, const UnholdableClaim& arc) {
  const std::size_t load = arc.load.value_or(0);
  return grasps[load < grasps.size() ? load : 0];
}

/// In their order from `start`.
std::vector<Piece> pieces_of(const EachLoad& grasps, const std::vector<RealArc>& arcs,
                             const std::vector<UnholdableClaim>& unholdable, Real start,
                             const OptionsClaim& options) {
  const bool of_grip = options.objective == Objective::grip;
  std::vector<Piece> pieces;
  for (const RealArc& arc : arcs) {
    if (arc.is_sliver()) continue;
    const auto at = [&](Real theta) {
      const RealGrasp& grasp = grasps[arc.load];
      const Vec y = arc.y * harmonics(theta);
      return of_grip ? grip_proof(grasp, y, arc.rates, options.force_cap) : proof(grasp, y, {}, 0);
    };
    pieces.push_back({arc.place, arc.from, arc.to, at(arc.from), at(arc.to), true});
  }
  for (std::size_t k = 0; k < unholdable.size(); ++k) {
    if (is_narrow(unholdable[k])) continue;
    // What is proven of the effort says nothing of the grip.
    const Vec3 proven = of_grip
                            ? Vec3(-infinity, 0, 0)
                            : proof(load_of(grasps, unholdable[k]), real(unholdable[k].y), {}, 0);
    pieces.push_back(
        {unholdable_path(k), unholdable[k].from, unholdable[k].to, proven, proven, false});
  }
  for (Piece& piece : pieces) {
    const Real from = unwound(piece.from, start);
    piece.to += from - piece.from;
    piece.from = from;
  }
  std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
    return a.from != b.from ? a.from < b.from : a.to < b.to;
  });
  return pieces;
}

/// A walk once around the domain. Between two pieces counts what any y that is at hand proves, the
/// neighbours' first.
class Walk {
 public:
  Walk(Verdict& verdict, const std::vector<Piece>& pieces, Real start, Status status)
      : verdict_(verdict), pieces_(pieces), status_(status), reached_(start) {}

  /// Starts behind a piece.
  void start_behind(const Piece& piece) { before_ = &piece; }

  /// Goes on to where `after` begins, or the domain ends.
  void reach(const Path& place, Real to, const Piece* after) {
    if (status_ != Status::gap)
      verdict_.check(place, "arcs and unholdable arcs cover the domain [rad]", to - reached_,
                     most_narrow);
    const bool by_arcs = (before_ && before_->arc) || (after && after->arc);
    if (to <= reached_ || (to - reached_ <= most_narrow && !by_arcs)) return;
    Real best = -infinity;
    const auto use = [&](const Vec3& proof) {
      best = std::max(best, verify::least(proof, reached_, to));
    };
    if (before_) use(before_->proof_to);
    if (after) use(after->proof_from);
    if (to - reached_ > end_slack)
      for (const Piece& piece : pieces_) {
        use(piece.proof_from);
        use(piece.proof_to);
      }
    least_ = std::min(least_, best);
  }

  void pass(const Piece& piece) {
    reach(piece.place, piece.from, &piece);
    verdict_.check(piece.place, "arcs do not overlap [rad]",
                   std::min(reached_, piece.to) - piece.from, end_slack);
    if (piece.to >= reached_) before_ = &piece;
    reached_ = std::max(reached_, piece.to);
  }

  Real reached() const { return reached_; }
  Real least() const { return least_; }  ///< proven between the pieces

 private:
  Verdict& verdict_;
  const std::vector<Piece>& pieces_;
  Status status_;
  Real reached_;
  const Piece* before_{nullptr};
  Real least_{infinity};
};

}  // namespace

Real check_cover(Verdict& verdict, const EachLoad& grasps, const std::vector<RealArc>& arcs,
                 const std::vector<UnholdableClaim>& unholdable, const RealDomain& domain,
                 Status status, const OptionsClaim& options) {
  Real start = domain.from;
  if (domain.circle && !(arcs.empty() && unholdable.empty()))
    start = arcs.empty() ? unholdable.front().from : arcs.front().from;
  const Real stop = domain.circle ? start + 2 * pi : domain.to;
  const std::vector<Piece> pieces = pieces_of(grasps, arcs, unholdable, start, options);
  const bool closed = domain.circle && !pieces.empty();
  Walk walk(verdict, pieces, start, status);
  if (closed)
    walk.start_behind(*std::max_element(
        pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.to < b.to; }));
  for (const Piece& piece : pieces) walk.pass(piece);
  walk.reach({}, stop, closed ? &pieces.front() : nullptr);
  verdict.check({}, "arcs keep to the domain [rad]", walk.reached() - stop, end_slack);
  Real least = walk.least();
  for (const RealArc& arc : arcs)
    if (!arc.is_sliver()) least = std::min(least, arc.value.least(arc.from, arc.to));
  return least;
}

void check_unholdable(Verdict& verdict, const EachLoad& grasps,
                      const std::vector<UnholdableClaim>& unholdable, Real force_cap) {
  for (std::size_t k = 0; k < unholdable.size(); ++k) {
    const Path place = unholdable_path(k);
    const RealGrasp& grasp = grasps[check_named_load(verdict, place, grasps, unholdable[k].load)];
    const Real cap = force_cap * grasp.loads.front().size();
    const Real width = Real{unholdable[k].to} - unholdable[k].from;
    verdict.check(place, "from_deg is not above to_deg, nor by more than a turn below",
                  width >= 0 && width <= 2 * pi + end_slack);
    if (is_narrow(unholdable[k])) {
      verdict.unchecked(place, "arcs narrower than 4e-8 rad prove nothing, their neighbours must");
      continue;
    }
    const Real from = unholdable[k].from + end_slack, to = unholdable[k].to - end_slack;
    const auto rates = real_rates(verdict, place, grasp, unholdable[k].rates);
    if (!rates) continue;
    Real best = 0;
    for (int exponent = -80; exponent <= 80 && best <= cap * cap; exponent += 2) {
      const Real length = std::ldexp(Real{1}, exponent);
      std::vector<Real> speeds = *rates;
      for (Real& speed : speeds) speed *= length;
      best = std::max(best,
                      least(proof(grasp, length * real(unholdable[k].y), speeds, delta), from, to));
    }
    verdict.check(place, "y proves that the force cap is not enough: cap^2 / bound",
                  best > 0 ? cap * cap / best : 2, 1);
  }
}

}  // namespace poise::verify
