// The posture that withstands most: docs/certificate.md, "sturdiest".
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "verify/curve.hpp"
#include "verify/shake.hpp"
#include "verify/trig.hpp"

namespace poise::verify {
namespace {

constexpr Real infinity = std::numeric_limits<Real>::infinity();
constexpr int most_halvings = 100;
constexpr long most_parts = 1'000'000;

template <int Dim>
using Up = Eigen::Matrix<Real, Dim, 1>;

/// With x for up, at most b - n . x is withstood.
template <int Dim>
struct Limit {
  Up<Dim> n;
  Real b;

  Real at(const Up<Dim>& x) const { return b - n.dot(x); }
};

/// Of a cut of one load; none where it says nothing.
template <int Dim>
std::optional<Limit<Dim>> limit_of(const RealGrasp& one, const Vec& y,
                                   const std::vector<Real>& rates, Real cap) {
  const RealLoad& load = one.loads.front();
  const Vec v = velocity(y, load.com);
  const Real rest = most_power(one, y, rates, cap) - y.dot(load.still());
  const Real speed = load.weight / standard_gravity * v.norm();
  if (speed > 0) return Limit<Dim>{load.turning() * v / speed, rest / speed};
  // What else the object undergoes has no power: whether it is held is all that there is to know.
  if (!(rest < 0)) return {};
  return Limit<Dim>{Up<Dim>::Zero(), -infinity};
}

/// The postures to choose from, as parts: arcs, or triangles of the sphere.
template <int Dim>
using Part = std::array<Up<Dim>, Dim>;

/// Whether all postures of a domain keep a limit, looked at by halves.
template <int Dim>
class Search {
 public:
  Search(const std::vector<Limit<Dim>>& limits, const std::optional<Tilt>& tilt, Real most)
      : limits_(limits), tilt_(tilt), most_(most) {}

  enum class State { kept, open, broken };

  State look(const Part<Dim>& part, int halvings = 0) {
    Up<Dim> middle = Up<Dim>::Zero();
    for (const Up<Dim>& corner : part) middle += corner;
    middle.normalize();
    Real along = 1;
    for (const Up<Dim>& corner : part) along = std::min(along, middle.dot(corner));
    if (is_outside(middle, std::acos(std::min(along, Real{1})))) return State::kept;
    // Its postures are vectors of the hull of its corners, made longer by at most 1 / along.
    for (const Limit<Dim>& limit : limits_) {
      Real greatest = -infinity;
      for (const Up<Dim>& corner : part)
        greatest = std::max({greatest, limit.at(corner), limit.at(corner / along)});
      if (greatest <= most_) return State::kept;
    }
    const bool is_inside = !is_outside(middle, 0);
    if (is_inside && std::all_of(limits_.begin(), limits_.end(),
                                 [&](const Limit<Dim>& limit) { return limit.at(middle) > most_; }))
      return State::broken;
    if (halvings >= most_halvings || ++parts_ > most_parts) return State::open;
    std::size_t a = 0, b = 1;
    for (std::size_t i = 0; i < Dim; ++i)
      for (std::size_t j = i + 1; j < Dim; ++j)
        if ((part[i] - part[j]).norm() > (part[a] - part[b]).norm()) a = i, b = j;
    const Up<Dim> between = (part[a] + part[b]).normalized();
    State state = State::kept;
    for (const std::size_t end : {a, b}) {
      Part<Dim> half = part;
      half[end] = between;
      state = std::max(state, look(half, halvings + 1));
      if (state == State::broken) return state;
    }
    return state;
  }

 private:
  bool is_outside(const Up<Dim>& up, Real by) const {
    if constexpr (Dim == 2) return false;  // the arcs are the domain
    if (!tilt_) return false;
    const Vec from = real(tilt_->from);
    const Real along = from.dot(up), across = (up - along * from).norm();
    return std::atan2(across, along) > tilt_->most + by + 1e-12L;
  }

  const std::vector<Limit<Dim>>& limits_;
  const std::optional<Tilt>& tilt_;
  Real most_;
  long parts_{0};
};

template <int Dim>
std::vector<Part<Dim>> parts_of(const RealGrasp& grasp, const OptionsClaim& options) {
  std::vector<Part<Dim>> parts;
  if constexpr (Dim == 2) {
    const RealDomain domain = domain_of(grasp, options.domain.value_or(Domain::all));
    const Real from = domain.circle ? 0 : domain.from, to = domain.circle ? 2 * pi : domain.to;
    const auto at = [&](int k) { return Up<2>(up_at(from + (to - from) * k / 6)); };
    for (int k = 0; k < 6; ++k) parts.push_back({at(k), at(k + 1)});
  } else {
    for (const int x : {1, -1})
      for (const int y : {1, -1})
        for (const int z : {1, -1})
          parts.push_back({Up<3>(x, 0, 0), Up<3>(0, y, 0), Up<3>(0, 0, z)});
  }
  return parts;
}

bool is_in_domain(const RealGrasp& grasp, const OptionsClaim& options, const Vector<2>& up) {
  const RealDomain domain = domain_of(grasp, options.domain.value_or(Domain::all));
  if (domain.circle) return true;
  const Vec middle = up_at((domain.from + domain.to) / 2), x = real(up);
  return std::acos(std::clamp(middle.dot(x), Real{-1}, Real{1})) <=
         (domain.to - domain.from) / 2 + 1e-9L;
}
bool is_in_domain(const RealGrasp&, const OptionsClaim& options, const Vector<3>& up) {
  if (!options.tilt) return true;
  const Vec from = real(options.tilt->from), x = real(up);
  const Real along = from.dot(x);
  return std::atan2((x - along * from).norm(), along) <= options.tilt->most + 1e-9L;
}

/// Checks the posture, and what it withstands.
template <int Dim>
void check_posture(Verdict& verdict, const std::vector<Grasp<Dim>>& ones, const RealGrasp& grasp,
                   const SturdyDocument<Dim>& sturdy) {
  const Vector<Dim>& up = *sturdy.up;
  verdict.check(Path() / "up", "up is a unit vector", std::abs(real(up).norm() - 1), rounding);
  verdict.check(Path() / "up", "up is in the domain", is_in_domain(grasp, sturdy.options, up));
  if constexpr (Dim == 2)
    verdict.check(Path() / "angle_deg", "angle_deg is that of up",
                  sturdy.angle_deg ? (up_at(radians_of(*sturdy.angle_deg)) - real(up)).norm() : 1,
                  rounding);
  Real least = infinity;
  for (std::size_t k = 0; k < ones.size(); ++k) {
    const ShakeClaim<Dim>& shake = sturdy.shakes[k];
    check_shake<Dim>(verdict, (Path() / "shakes")[k], ones[k], up, shake, sturdy.options.force_cap);
    least = std::min(least, shake.acceleration ? Real{*shake.acceleration} : infinity);
  }
  const Real told = sturdy.acceleration ? Real{*sturdy.acceleration} : infinity;
  verdict.check(Path() / "acceleration", "acceleration is the least of the loads'",
                told == least ? 0 : difference(told, least), rounding);
}

}  // namespace

template <int Dim>
void check_sturdy(Verdict& verdict, const Grasp<Dim>& given, const RealGrasp& grasp,
                  const SturdyDocument<Dim>& sturdy) {
  const OptionsClaim& options = sturdy.options;
  if constexpr (Dim == 2)
    check_options(verdict, Dim, options, {"domain", "gap", "max_holds"});
  else
    check_options(verdict, Dim, options, {"gap", "max_holds"}, {"tilt"});
  verdict.unchecked(Path() / "holds", "how many holds the search took");
  const bool found = sturdy.up.has_value();
  const bool complete = sturdy.shakes.size() == (found ? given.loads().size() : 0);
  verdict.check(Path() / "shakes", "what each load withstands is told where there is a posture",
                complete);
  verdict.check(Path() / "status", "there is a posture unless it is unholdable, or a gap",
                found ? sturdy.status != Status::unholdable : sturdy.status != Status::optimal);
  if (!complete) return;
  std::vector<Grasp<Dim>> ones;
  for (const Load<Dim>& load : given.loads())
    ones.emplace_back(load, given.contacts(), 1, given.mechanism());
  if (found) {
    check_posture<Dim>(verdict, ones, grasp, sturdy);
  } else {
    verdict.check(Path() / "acceleration", "is null where nothing is held", !sturdy.acceleration);
    if constexpr (Dim == 2)
      verdict.check(Path() / "angle_deg", "is null where nothing is held", !sturdy.angle_deg);
  }

  const Real bound = sturdy.bound ? Real{*sturdy.bound} : infinity;
  const Real reached = !found ? 0 : sturdy.acceleration ? Real{*sturdy.acceleration} : infinity;
  const Real near = found ? reached * (1 + Real{options.gap.value_or(0)}) + no_acceleration : 0;
  if (sturdy.status == Status::unholdable)
    verdict.check(Path() / "bound", "nothing is withstood anywhere: the bound is 0",
                  std::abs(bound), 0);
  else
    verdict.check(Path() / "bound", "bound is not below what is withstood",
                  reached == infinity ? (bound == infinity ? 0 : 1) : reached - bound, 0);
  if (sturdy.status == Status::optimal)
    verdict.check(Path() / "bound", "the gap is closed: bound is acceleration, but for the gap",
                  near == infinity ? 0 : bound - near, rounding * reached);
  if (sturdy.status == Status::gap) {
    verdict.check(Path() / "status", "status is gap only where the gap is open", bound > near);
    verdict.leave_open("A posture may exist that withstands more.");
  }
  verdict.unchecked(Path() / "bound", "that cuts prove no less");
  const Path list = Path() / "cuts";
  if (bound == infinity)
    return verdict.check(list, "without a bound there are no cuts", sturdy.cuts.empty());
  std::vector<RealGrasp> reals;
  for (const Grasp<Dim>& one : ones) reals.push_back(real_grasp(one));
  std::vector<Limit<Dim>> limits;
  for (std::size_t k = 0; k < sturdy.cuts.size(); ++k) {
    const SturdyCutClaim<Dim>& cut = sturdy.cuts[k];
    const std::size_t load = cut.load.value_or(0);
    const bool known = cut.load.has_value() == (ones.size() > 1) && load < ones.size();
    verdict.check(list[k] / "load", "load is one of the grasp's, told where there are several",
                  known);
    if (!known) continue;
    const auto rates = real_rates(verdict, list[k] / "rates", reals[load], cut.rates);
    if (!rates) continue;
    const auto limit = limit_of<Dim>(reals[load], real(cut.y), *rates, options.force_cap);
    if (limit) limits.push_back(*limit);
  }
  Search<Dim> search(limits, options.tilt, bound + follows * bound + no_acceleration);
  using State = typename Search<Dim>::State;
  State state = State::kept;
  for (const Part<Dim>& part : parts_of<Dim>(grasp, options))
    state = std::max(state, search.look(part));
  if (state == State::open)
    verdict.leave_open("Whether the cuts bound all postures takes too long to see.");
  verdict.check(list, "no posture withstands more than bound, by the cuts", state != State::broken);
}

template void check_sturdy(Verdict&, const Grasp<2>&, const RealGrasp&, const SturdyDocument<2>&);
template void check_sturdy(Verdict&, const Grasp<3>&, const RealGrasp&, const SturdyDocument<3>&);

}  // namespace poise::verify
