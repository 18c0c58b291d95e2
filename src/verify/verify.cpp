#include "verify/verify.hpp"

#include <algorithm>
#include <cmath>

#include "verify/checks.hpp"

namespace poise::verify {
namespace {

Real distance(double a, double b) { return difference(a, b); }
Real distance(const std::string& a, const std::string& b) { return a == b ? 0 : 1; }
template <int Dim>
Real distance(const Eigen::Matrix<double, Dim, 1>& a, const Eigen::Matrix<double, Dim, 1>& b) {
  return (real(a) - real(b)).norm();
}

/// Checks that the grasp is told as it is.
template <int Dim>
void check_reading(Verdict& verdict, const Grasp<Dim>& grasp, const CheckDocument<Dim>& check) {
  const auto same = [&](const Path& place, const std::string& key, const auto& a, const auto& b) {
    verdict.check(place / key, key + " is that of the grasp", distance(a, b), 0);
  };
  const bool complete = check.loads.size() == grasp.loads().size() &&
                        check.contacts.size() == grasp.contacts().size();
  verdict.check({}, "there are as many loads and contacts as the grasp has", complete);
  if (!complete) return;
  for (std::size_t k = 0; k < check.loads.size(); ++k) {
    const Path place = Dim == 2 ? Path() : (Path() / "scenarios")[k];
    same(place, "weight", check.loads[k].weight, grasp.loads()[k].weight);
    same(place, "com", check.loads[k].com, grasp.loads()[k].com);
  }
  for (std::size_t i = 0; i < check.contacts.size(); ++i)
    for_each_contact_field<Dim>([&](const char* name, auto member) {
      same((Path() / "contacts")[i], name, check.contacts[i].*member, grasp.contacts()[i].*member);
    });
  verdict.note("force_closure, cradled_deg and warnings are not checked.");
}

/// Calls what checks a document of its kind.
template <int Dim>
struct Checker {
  Verdict& verdict;
  const Grasp<Dim>& given;
  RealGrasp grasp{real_grasp(given)};

  void operator()(const CheckDocument<Dim>& check) { check_reading(verdict, given, check); }
  void operator()(const HoldDocument<Dim>& hold) {
    check_least_hold<Dim>(verdict, {}, grasp, hold, hold.options.force_cap);
  }
  void operator()(const BestDocument<Dim>& best) { check_best(verdict, grasp, best); }
  void operator()(const CapacityDocument<Dim>& capacity) {
    check_capacity(verdict, grasp, capacity);
  }
  void operator()(const CurveDocument& curve) { check_curve(verdict, grasp, curve); }
};

}  // namespace

template <int Dim>
Verdict verify(const Grasp<Dim>& grasp, const AnyDocument<Dim>& document) {
  Verdict verdict;
  std::visit(Checker<Dim>{verdict, grasp}, document);
  return verdict;
}

template Verdict verify(const Grasp<2>&, const AnyDocument<2>&);
template Verdict verify(const Grasp<3>&, const AnyDocument<3>&);

Verdict verify(const GraspFile& file, const Document& result) {
  if (const auto* planar = std::get_if<PlanarFile>(&file))
    return verify<2>(planar->grasp(), read_document<2>(result));
  return verify<3>(std::get<SpatialFile>(file).grasp(), read_document<3>(result));
}

}  // namespace poise::verify
