#include "verify/verify.hpp"

#include <algorithm>
#include <cmath>

#include "verify/checks.hpp"
#include "verify/trig.hpp"

namespace poise::verify {
namespace {

Real distance(double a, double b) { return difference(a, b); }
Real distance(const std::optional<Pad>& a, const std::optional<Pad>& b) { return a == b ? 0 : 1; }
Real distance(const std::string& a, const std::string& b) { return a == b ? 0 : 1; }
template <int Dim>
Real distance(const Eigen::Matrix<double, Dim, 1>& a, const Eigen::Matrix<double, Dim, 1>& b) {
  return (real(a) - real(b)).norm();
}

bool same(const std::optional<Vec>& a, const std::optional<Vec>& b) {
  return a.has_value() == b.has_value() && (!a || (*a - *b).norm() <= rounding);
}

template <int Dim>
std::optional<Vec> maybe_real(const std::optional<Vector<Dim>>& v) {
  return v ? std::optional<Vec>(real(*v)) : std::nullopt;
}

Present present(const PlanarFile& file) {
  return {true, file.angle ? std::optional(up_at(*file.angle)) : std::nullopt};
}
Present present(const SpatialFile& file) { return {true, maybe_real<3>(file.up)}; }

/// Checks what is said of the posture now, and of those to choose from.
void check_file(Verdict& verdict, const PlanarFile& file, const CheckDocument<2>& check) {
  const std::optional<Vec> up =
      check.angle_deg ? std::optional(up_at(radians_of(*check.angle_deg))) : std::nullopt;
  verdict.check(Path() / "angle_deg", "angle_deg is that of the file", same(up, present(file).up));
  verdict.check(Path() / "domain", "domain is that of the file", check.domain == file.domain);
}
void check_file(Verdict& verdict, const SpatialFile& file, const CheckDocument<3>& check) {
  verdict.check(Path() / "up", "up is that of the file",
                same(maybe_real<3>(check.up), present(file).up));
  const bool is_same = check.tilt.has_value() == file.tilt.has_value() &&
                       (!check.tilt || (same(real(check.tilt->from), real(file.tilt->from)) &&
                                        difference(check.tilt->most, file.tilt->most) <= rounding));
  verdict.check(Path() / "tilt", "tilt is that of the file", is_same);
}

/// Checks that the grasp is told as it is.
template <int Dim>
void check_reading(Verdict& verdict, const Grasp<Dim>& grasp, const FileOf<Dim>* file,
                   const CheckDocument<Dim>& check) {
  const auto same = [&](const Path& place, const std::string& key, const auto& a, const auto& b) {
    verdict.check(place / key, key + " is that of the grasp", distance(a, b), 0);
  };
  verdict.check(Path() / "dimension", "dimension is that of the grasp", check.dimension == Dim);
  const bool complete = check.loads.size() == grasp.loads().size() &&
                        check.contacts.size() == grasp.contacts().size();
  verdict.check({}, "there are as many loads and contacts as the grasp has", complete);
  if (!complete) return;
  for (std::size_t k = 0; k < check.loads.size(); ++k) {
    same((Path() / "loads")[k], "name", check.loads[k].name, grasp.loads()[k].name);
    for_each_load_field<Dim>([&](const char* name, auto member) {
      same((Path() / "loads")[k], name, check.loads[k].*member, grasp.loads()[k].*member);
    });
  }
  for (std::size_t i = 0; i < check.contacts.size(); ++i)
    for_each_contact_field<Dim>([&](const char* name, auto member) {
      same((Path() / "contacts")[i], name, check.contacts[i].*member, grasp.contacts()[i].*member);
    });
  for (const char* const key : {"name", "shape", "force_closure", "fork_deg", "warnings"})
    verdict.unchecked(Path() / key, "follows from the file");
  if (file) {
    verdict.check(Path() / "safety", "safety is that of the file",
                  difference(check.safety, file->safety), 0);
    return check_file(verdict, *file, check);
  }
  for (const char* const key : {"safety", "angle_deg", "domain", "up", "tilt"})
    verdict.unchecked(Path() / key, "is of the file, which is not at hand");
}

/// Calls what checks a document of its kind.
template <int Dim>
struct Checker {
  Verdict& verdict;
  const Grasp<Dim>& given;
  const FileOf<Dim>* file;
  RealGrasp grasp{real_grasp(given)};
  Present now{file ? present(*file) : Present{}};

  void operator()(const CheckDocument<Dim>& check) { check_reading(verdict, given, file, check); }
  void operator()(const HoldDocument<Dim>& hold) {
    check_options(verdict, Dim, hold.options, {"objective"}, {"angle_deg", "up"});
    // That there are no forces at all is told in terms of the effort.
    verdict.check(Path() / "objective", "objective is that of the options",
                  hold.objective == hold.options.objective ||
                      (!hold.holdable && hold.objective == Objective::effort));
    check_least_hold<Dim>(verdict, {}, grasp, hold, hold.options.force_cap);
    if (hold.proven) verdict.leave_open("Neither forces are claimed, nor that there are none.");
    if (const auto up = asked_up(hold.options))
      check_up(verdict, {}, real(hold.up), *up, "up is the posture asked for");
    else if (now.known)
      check_up(verdict, {}, real(hold.up), now.up.value_or(upright(Dim)),
               "up is the posture of the file");
    else
      verdict.note("Whether up is the posture of the file is not known here.");
  }
  void operator()(const BestDocument<Dim>& best) {
    check_best(verdict, grasp, best);
    check_turns(verdict, given, grasp, best);
    check_present(best.options);
  }
  void operator()(const TurnDocument<Dim>& turn) {
    check_turn_document(verdict, given, grasp, turn);
    check_present(turn.options);
  }
  void operator()(const CapacityDocument<Dim>& capacity) {
    check_capacity(verdict, grasp, capacity, now);
    check_shakes(verdict, given, capacity);
  }
  void operator()(const SturdyDocument<Dim>& sturdy) {
    check_sturdy(verdict, given, grasp, sturdy);
  }
  void operator()(const CurveDocument& curve) {
    check_curve(verdict, grasp, curve);
    check_present(curve.options);
  }

 private:
  /// Checks that of ties the nearest to the file's posture was asked for.
  void check_present(const OptionsClaim& options) {
    if (!options.present_deg) return;
    const Path place = Path() / "options" / "present_deg";
    if (now.known)
      verdict.check(place, "present_deg is the posture of the file, or 0",
                    (up_at(radians_of(*options.present_deg)) - now.up.value_or(upright(2))).norm(),
                    rounding);
    else
      verdict.unchecked(place, "is of the file, which is not at hand");
  }
};

template <int Dim>
Verdict verdict_of(const Grasp<Dim>& grasp, const FileOf<Dim>* file,
                   const AnyDocument<Dim>& document) {
  Verdict verdict;
  std::visit(Checker<Dim>{verdict, grasp, file}, document);
  return verdict;
}

}  // namespace

template <int Dim>
Verdict verify(const Grasp<Dim>& grasp, const AnyDocument<Dim>& document) {
  return verdict_of<Dim>(grasp, nullptr, document);
}

template Verdict verify(const Grasp<2>&, const AnyDocument<2>&);
template Verdict verify(const Grasp<3>&, const AnyDocument<3>&);

Verdict verify(const GraspFile& file, const Document& result) {
  return std::visit(
      [&]<class File>(const File& own) {
        constexpr int Dim = std::is_same_v<File, PlanarFile> ? 2 : 3;
        return verdict_of<Dim>(own.grasp(), &own, read_document<Dim>(result));
      },
      file);
}

}  // namespace poise::verify
