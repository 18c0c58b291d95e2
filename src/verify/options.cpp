#include <algorithm>
#include <cmath>

#include "verify/checks.hpp"
#include "verify/trig.hpp"

namespace poise::verify {
namespace {

/// An option as the program would take it.
struct Option {
  std::string_view key;
  const char* must_be;
  bool given, right;
};

bool is_unit(const Vec& v) { return std::abs(v.norm() - 1) <= rounding; }

bool is_right(const Tilt& tilt) {
  return is_unit(real(tilt.from)) && tilt.most >= 0 && tilt.most <= pi / 2 + rounding;
}

bool is_right(const RotationClaim& q) {
  return !q.angle_deg && is_unit(real(Eigen::Matrix<double, 4, 1>(q.w, q.x, q.y, q.z)));
}

bool is_right(const std::vector<double>& up, int dim) {
  return static_cast<int>(up.size()) == dim &&
         std::any_of(up.begin(), up.end(), [](double x) { return x != 0; });
}

bool has(const std::vector<std::string_view>& keys, std::string_view key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

}  // namespace

void check_options(Verdict& verdict, int dim, const OptionsClaim& given,
                   const std::vector<std::string_view>& needed,
                   const std::vector<std::string_view>& possible) {
  const auto& [domain, present, force_cap, objective, gap, max_holds, tilt, orientation, safety,
               grip, angle, up] = given;
  const Option options[] = {
      {"force_cap", "is above 0 and at most 1e9", true, force_cap > 0 && force_cap <= 1e9},
      {"domain", "is all in space", domain.has_value(), dim == 2 || domain == Domain::all},
      {"present_deg", "is in (-180, 180], in the plane", present.has_value(),
       dim == 2 && present > -180 && present <= 180},
      {"objective", "is told", objective.has_value(), true},
      {"gap", "is above 0 and below 1", gap.has_value(), gap > 0 && gap < 1},
      {"max_holds", "is from 1 to 1000000", max_holds.has_value(),
       max_holds >= 1 && max_holds <= 1'000'000},
      {"tilt", "is from a unit vector, 0 to 90 degrees", tilt.has_value(), tilt && is_right(*tilt)},
      {"orientation", "is a quaternion of length 1", orientation.has_value(),
       orientation && is_right(*orientation)},
      {"safety", "is at least 1", safety.has_value(), safety >= 1},
      {"grip", "is above 0 and finite", grip.has_value(), grip > 0 && std::isfinite(*grip)},
      {"angle_deg", "is in (-180, 180], and there is no up", angle.has_value(),
       angle > -180 && angle <= 180 && !up},
      {"up", "is a direction", up.has_value(), up && is_right(*up, dim)}};
  for (const Option& option : options) {
    const Path place = Path() / "options" / option.key;
    const std::string key(option.key);
    if (has(needed, option.key)) verdict.check(Path() / "options", key + " is told", option.given);
    if (!option.given) continue;
    verdict.check(place, key + " is an option of the command",
                  key == "force_cap" || has(needed, option.key) || has(possible, option.key));
    verdict.check(place, key + " " + option.must_be, option.right);
  }
}

std::optional<Vec> asked_up(const OptionsClaim& options) {
  if (options.angle_deg) return up_at(radians_of(*options.angle_deg));
  if (!options.up) return {};
  const std::vector<double>& numbers = *options.up;
  const Vec up =
      Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()))
          .cast<Real>();
  return Vec(up.stableNormalized());
}

void check_up(Verdict& verdict, const Path& place, const Vec& up, const Vec& expected,
              const std::string& words) {
  verdict.check(place / "up", words, up.size() == expected.size() ? (up - expected).norm() : 1,
                rounding);
}

Vec upright(int dim) { return Vec::Unit(dim, dim - 1); }

}  // namespace poise::verify
