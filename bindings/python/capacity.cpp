#include "poise/capacity.hpp"

#include <cmath>

#include "module.hpp"
#include "values.hpp"

namespace poise::python {
namespace {

using AnyEnd = Either<WeightEnd>;
using AnyRange = Either<WeightRange>;
using AnyFriction = Either<LeastFriction>;
using AnyCapacity = Either<Capacity>;

using Index = std::optional<std::size_t>;

/// What `f(grasp, load, up, settings)` makes of a grasp of either dimension, against one of its
/// loads, in the posture `up`.
template <class R, class F>
R in_posture(const AnyGrasp& any, const Eigen::VectorXd& up, Index load, double force_cap, F f) {
  const HoldSettings settings{.force_cap = checked_cap(force_cap)};
  return std::visit(
      [&]<int Dim>(const Grasp<Dim>& grasp) {
        return R{f(grasp, load_of(grasp, load), unit<Dim>(up), settings)};
      },
      any.of);
}

using Rates = SmallVector<double, 4>;

Eigen::VectorXd vector_of(const Rates& rates) {
  return Eigen::Map<const Eigen::VectorXd>(rates.data(), static_cast<Eigen::Index>(rates.size()));
}

/// Of each drive, or none.
template <int Dim>
Rates checked_rates(const Grasp<Dim>& grasp, const std::optional<Eigen::VectorXd>& given) {
  Rates rates;
  if (!given || given->size() == 0) return rates;
  const std::vector<Drive<Dim>> drives = grasp.drives();
  rates.resize(static_cast<std::size_t>(given->size()));
  if (rates.size() != drives.size())
    throw InvalidGrasp("rates", "has " + std::to_string(rates.size()) + " numbers, must have " +
                                    std::to_string(drives.size()) + ", one for each drive");
  for (std::size_t a = 0; a < rates.size(); ++a) {
    rates[a] = (*given)[static_cast<Eigen::Index>(a)];
    if (!(rates[a] >= 0) || !std::isfinite(rates[a]) ||
        (rates[a] > 0 && !std::isfinite(drives[a].max)))
      throw InvalidGrasp("rates[" + std::to_string(a) + "]",
                         "must be at least 0, and 0 of a drive without max");
  }
  return rates;
}

std::vector<Deciding> deciding_contacts(const AnyGrasp& any, const Eigen::VectorXd& up,
                                        const Eigen::VectorXd& dual,
                                        const std::optional<Eigen::VectorXd>& rates, Index index,
                                        double force_cap) {
  if (!dual.allFinite()) throw InvalidGrasp("dual", "must be finite");
  return in_posture<std::vector<Deciding>>(
      any, up, index, force_cap,
      [&]<int Dim>(const Grasp<Dim>& grasp, const Load<Dim>& load, const Vector<Dim>& unit_up,
                   const HoldSettings& settings) {
        return deciding<Dim>(grasp, load, unit_up, sized<wrench_size<Dim>>(dual, "dual"),
                             checked_rates(grasp, rates), settings);
      });
}

std::vector<double> drives_that_decide(const AnyGrasp& any, const Eigen::VectorXd& up,
                                       const Eigen::VectorXd& dual,
                                       const std::optional<Eigen::VectorXd>& rates, Index index,
                                       double force_cap) {
  if (!dual.allFinite()) throw InvalidGrasp("dual", "must be finite");
  return in_posture<std::vector<double>>(
      any, up, index, force_cap,
      [&]<int Dim>(const Grasp<Dim>& grasp, const Load<Dim>& load, const Vector<Dim>& unit_up,
                   const HoldSettings& settings) {
        return deciding_drives<Dim>(grasp, load, unit_up, sized<wrench_size<Dim>>(dual, "dual"),
                                    checked_rates(grasp, rates), settings);
      });
}

/// A member of either dimension that has a type of its own in each.
template <template <int> class Part, class E, class Get>
auto part(Get get) {
  return each<E>([get](const auto& whole) { return Either<Part>{get(whole)}; });
}

/// The hold of a posture; an empty one where there is none.
template <int Dim>
AnyHold hold_of(const Posture<Dim>& posture) {
  return {posture.holds.empty() ? Hold<Dim>() : posture.hold()};
}

constexpr const char* dual_text =
    "A twist y about the object frame's origin, (3,) or (6,): velocity, angular velocity [1/m]. "
    "For\n"
    "every weight that is held with a force norm of at most force_cap weights\n"
    "  weight (y . w(1 N) - force_cap |P(z)|) <= sum of rates . max + greatest z . f of contacts\n"
    "with max_normal, where z is y against the fingers that move with the rates, and P(z) what\n"
    "contacts without max_normal can do against it. Zero where there is no bound.";

void add_types(py::module_& module) {
  Class<AnyEnd>(module, "WeightEnd")
      .either(
          "weight", [](const auto& end) { return end.weight; }, "Can be held, by hold [N].")
      .either("bound", [](const auto& end) { return end.bound; })
      .either("hold", [](const auto& end) { return hold_of(end.posture); })
      .either(
          "dual", [](const auto& end) -> Eigen::VectorXd { return end.dual; }, dual_text)
      .either(
          "rates", [](const auto& end) { return vector_of(end.rates); },
          "Of the drives, >= 0, where any has a max; else empty.")
      .def("__repr__", each<AnyEnd>([](const auto& end) {
             return py::str("WeightEnd({:.6g} N)").format(end.weight);
           }));

  Class<AnyRange>(module, "WeightRange")
      .either("holdable", [](const auto& range) { return range.holdable; })
      .attribute("least", part<WeightEnd, AnyRange>([](const auto& range) { return range.least; }))
      .attribute("greatest",
                 part<WeightEnd, AnyRange>([](const auto& range) { return range.greatest; }))
      .def("__repr__", each<AnyRange>([](const auto& range) {
             if (!range.holdable) return py::str("WeightRange(unholdable)");
             return py::str("WeightRange({:.6g} to {:.6g} N)")
                 .format(range.least.weight, range.greatest.weight);
           }));

  Class<Deciding>(module, "Deciding")
      .attribute("per_newton", &Deciding::per_newton)
      .attribute("slipping", &Deciding::slipping)
      .def("__repr__", [](const Deciding& contact) {
        return py::str("Deciding(per_newton={:.6g}, slipping={})")
            .format(contact.per_newton, contact.slipping);
      });

  Class<AnyFriction>(module, "LeastFriction")
      .either(
          "factor", [](const auto& least) { return least.factor; },
          "The weight is held with it, by hold. Infinite where even a million "
          "times the friction is too\nlittle.")
      .either("bound", [](const auto& least) { return least.bound; })
      .either("hold", [](const auto& least) { return hold_of(least.posture); })
      .either("dual", [](const auto& least) -> Eigen::VectorXd { return least.dual; })
      .either("rates", [](const auto& least) { return vector_of(least.rates); })
      .def("__repr__", each<AnyFriction>([](const auto& least) {
             return py::str("LeastFriction(factor={:.6g})").format(least.factor);
           }));

  Class<AnyCapacity>(module, "Capacity")
      .attribute("weights",
                 part<WeightRange, AnyCapacity>([](const auto& answer) { return answer.weights; }))
      .attribute("friction", part<LeastFriction, AnyCapacity>(
                                 [](const auto& answer) { return answer.friction; }))
      .either(
          "safe", [](const auto& answer) { return hold_of(answer.safe); },
          "The hold of least grip with the friction divided by safety: its grip is what to "
          "command. "
          "Of a\ngrasp without a grip the hold of least effort.")
      .def("__repr__", each<AnyCapacity>([](const auto& answer) {
             return py::str("Capacity(weights={}, friction={})")
                 .format(py::cast(AnyRange{answer.weights}),
                         py::cast(AnyFriction{answer.friction}));
           }));
}

enum class Drives { same, unlimited };

/// A grasp like another.
template <class Change>
std::shared_ptr<AnyGrasp> like(const AnyGrasp& any, Drives drives, Change change) {
  return std::visit(
      [&]<int Dim>(const Grasp<Dim>& grasp) {
        std::vector<Load<Dim>> loads = grasp.loads();
        std::vector<Contact<Dim>> contacts = given_contacts(grasp);
        change(loads, contacts);
        return std::make_shared<AnyGrasp>(AnyGrasp{Grasp<Dim>(
            loads, contacts, 1, drives == Drives::same ? grasp.mechanism() : Mechanism<Dim>())});
      },
      any.of);
}

std::shared_ptr<AnyGrasp> with_weight(const AnyGrasp& grasp, double weight) {
  return like(grasp, Drives::same, [&](auto& loads, auto&) {
    for (auto& load : loads) load.weight = weight;
  });
}

std::shared_ptr<AnyGrasp> with_friction(const AnyGrasp& grasp, double factor) {
  return like(grasp, Drives::same, [&](auto&, auto& contacts) {
    for (auto& contact : contacts) {
      contact.friction *= factor;
      contact.torsion *= factor;
    }
  });
}

std::shared_ptr<AnyGrasp> without_limits(const AnyGrasp& grasp) {
  return like(grasp, Drives::unlimited, [](auto&, auto& contacts) {
    for (auto& contact : contacts) {
      contact.min_normal = 0;
      if (std::isfinite(contact.max_normal)) contact.max_normal = 0;
    }
  });
}

}  // namespace

void add_capacity(py::module_& module) {
  add_types(module);
  const py::call_guard<py::gil_scoped_release> unlocked;

  module.def(
      "weight_range",
      [](const AnyGrasp& grasp, const Eigen::VectorXd& up, Index load, double force_cap) {
        return in_posture<AnyRange>(grasp, up, load, force_cap,
                                    [](const auto&... all) { return weight_range(all...); });
      },
      py::arg("grasp"), py::arg("up"), py::kw_only(), py::arg("load") = py::none(),
      py::arg("force_cap") = 1e6, unlocked,
      "The weights that can be held in the posture up (2,) or (3,), whatever the grasp's own. "
      "Weight\nand bound of each end differ by a part of 1e-7, or by what rounding leaves "
      "open.\n\nload: of which, an index, where the grasp has several");
  module.def("deciding", &deciding_contacts, py::arg("grasp"), py::arg("up"), py::arg("dual"),
             py::arg("rates") = py::none(), py::kw_only(), py::arg("load") = py::none(),
             py::arg("force_cap") = 1e6, unlocked,
             "A Deciding for each contact, read off the proof of an end: its dual (3,) or (6,) and "
             "rates,\nin the posture up (2,) or (3,). load: of which, an index, where there are "
             "several.");
  module.def("deciding_drives", &drives_that_decide, py::arg("grasp"), py::arg("up"),
             py::arg("dual"), py::arg("rates") = py::none(), py::kw_only(),
             py::arg("load") = py::none(), py::arg("force_cap") = 1e6, unlocked,
             "Of each drive how many newtons more can be held at most for each newton, or newton "
             "metre,\nmore of its max, read off the proof of an end: its dual and rates. load: as "
             "of deciding.");
  module.def(
      "least_friction",
      [](const AnyGrasp& grasp, const Eigen::VectorXd& up, Index load, double force_cap) {
        return in_posture<AnyFriction>(grasp, up, load, force_cap,
                                       [](const auto&... all) { return least_friction(all...); });
      },
      py::arg("grasp"), py::arg("up"), py::kw_only(), py::arg("load") = py::none(),
      py::arg("force_cap") = 1e6, unlocked,
      "The least friction for the grasp's weight in the posture up (2,) or (3,). Factor and bound\n"
      "differ by a part of 1e-7, or by what rounding leaves open.\n\n"
      "load: of which, an index, where the grasp has several");
  module.def(
      "capacity",
      [](const AnyGrasp& any, const Eigen::VectorXd& up, double safety, Index index,
         double force_cap) {
        return in_posture<AnyCapacity>(any, up, index, force_cap,
                                       [safety](const auto& grasp, const auto& load,
                                                const auto& unit_up, const HoldSettings& settings) {
                                         return capacity(grasp, load, unit_up, safety, settings);
                                       });
      },
      py::arg("grasp"), py::arg("up"), py::arg("safety"), py::kw_only(),
      py::arg("load") = py::none(), py::arg("force_cap") = 1e6, unlocked,
      "What the gripper can hold in the posture up (2,) or (3,).\n\n"
      "safety: at least 1, on top of the one that the grasp was made with\n"
      "load: of which, an index, where the grasp has several");
  module.def("with_weight", &with_weight, py::arg("grasp"), py::arg("weight"),
             "The same contacts on an object of another weight [N], that of each of its loads.");
  module.def("with_friction", &with_friction, py::arg("grasp"), py::arg("factor"),
             "The same grasp with all frictions and torsions multiplied by a factor >= 0.");
  module.def("without_limits", &without_limits, py::arg("grasp"),
             "The contacts without max_normal alone, the others made to press with nothing, none "
             "with a\nmin_normal: what these can hold once they can hold at any size.");
}

}  // namespace poise::python
