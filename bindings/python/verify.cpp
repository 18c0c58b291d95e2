#include "verify/verify.hpp"

#include "curve_settings.hpp"
#include "module.hpp"
#include "turned.hpp"

namespace poise::python {
namespace {

using verify::Refutation;
using verify::Verdict;

/// What the text of a document says of a grasp.
Verdict check_text(const AnyGrasp& any, const std::string& text) {
  return std::visit(
      [&]<int Dim>(const Grasp<Dim>& grasp) {
        return verify::verify<Dim>(grasp, read_document<Dim>(parse_json(text, "", max_result)));
      },
      any.of);
}

Verdict check_dictionary(const AnyGrasp& grasp, const py::dict& document) {
  return check_text(grasp, py::module_::import("json").attr("dumps")(document).cast<std::string>());
}

Verdict check_hold(const AnyGrasp& any, const AnyHold& hold, const Eigen::VectorXd& up,
                   std::optional<std::size_t> load, double force_cap) {
  return each(any, hold, [&]<int Dim>(const Grasp<Dim>& grasp, const Hold<Dim>& own) {
    const Grasp<Dim> one(load_of(grasp, load), given_contacts(grasp), 1, grasp.mechanism());
    const HoldSettings settings{.force_cap = checked_cap(force_cap), .objective = own.objective};
    const HoldAnswer<Dim> answer{{}, settings, posture_of(one, unit<Dim>(up), {own})};
    return verify::verify(one, answer);
  });
}

Verdict check_best(const AnyGrasp& grasp, const Best<2>& best, Domain domain, double force_cap) {
  return verify::verify(
      only<2>(grasp),
      BestAnswer<2>{.settings = curve_settings(domain, force_cap, best.proof.curve.objective),
                    .best = best});
}

Verdict check_best_in_space(const AnyGrasp& grasp, const Best<3>& best, double force_cap,
                            double gap, const py::object& tilt) {
  BestAnswer<3> answer{.settings = {}, .best = best};
  answer.settings.force_cap = checked_cap(force_cap);
  answer.settings.gap = gap;
  answer.settings.tilt = read_tilt(tilt);
  return verify::verify(only<3>(grasp), answer);
}

template <int Dim>
Verdict check_turn(const AnyGrasp& grasp, const Turned<Dim>& turn) {
  return verify::verify(only<Dim>(grasp), turn.answer);
}

}  // namespace

void add_verify(py::module_& module) {
  py::class_<Refutation>(module, "Refutation", "A claim that is not true.")
      .def_readonly("claim", &Refutation::words, "What is claimed.")
      .def_readonly("path", &Refutation::path, "Where: \"minima[1].contacts[0]\".")
      .def_property_readonly(
          "off", [](const Refutation& each) { return static_cast<double>(each.off); },
          "How far it is from the truth.")
      .def_property_readonly(
          "allowed", [](const Refutation& each) { return static_cast<double>(each.allowed); },
          "How far it may be.")
      .def("__repr__", [](const Refutation& each) {
        return py::str("Refutation({}: {})").format(each.path, each.words);
      });
  py::class_<Verdict>(module, "Verdict", "What came of checking an answer again.")
      .def_property_readonly("confirmed", &Verdict::confirmed, "Whether all claims are true.")
      .def_property_readonly("refuted", &Verdict::refutations, "The claims that are not.")
      .def_property_readonly(
          "unchecked",
          [](const Verdict& verdict) {
            std::vector<std::pair<std::string, std::string>> list;
            for (const verify::Unchecked& each : verdict.unchecked())
              list.emplace_back(each.where, each.words);
            return list;
          },
          "What is claimed and not checked: where, and why.")
      .def_property_readonly("notes", &Verdict::notes, "What is not claimed.")
      .def("__bool__", &Verdict::confirmed)
      .def("__repr__", [](const Verdict& verdict) {
        return py::str("Verdict({})")
            .format(verdict.confirmed() ? py::object(py::str("confirmed"))
                                        : py::cast(verdict.refutations()));
      });

  const char* const words =
      "Checks an answer again, from the grasp alone, by code that shares nothing with what finds "
      "it:\n"
      "a document of the program, as text or as a dictionary; a hold in the posture up, against "
      "the\n"
      "load of an index where there are several; the best posture; or a turn. The settings are "
      "those with which it was asked for.";
  module.def("verify", &check_text, py::arg("grasp"), py::arg("document"), words);
  module.def("verify", &check_dictionary, py::arg("grasp"), py::arg("document"), words);
  module.def("verify", &check_hold, py::arg("grasp"), py::arg("hold"), py::arg("up"), py::kw_only(),
             py::arg("load") = py::none(), py::arg("force_cap") = 1e6, words);
  module.def("verify", &check_best, py::arg("grasp"), py::arg("best"), py::kw_only(),
             py::arg("domain") = Domain::all, py::arg("force_cap") = 1e6, words);
  module.def("verify", &check_best_in_space, py::arg("grasp"), py::arg("best"), py::kw_only(),
             py::arg("force_cap") = 1e6, py::arg("gap") = SpatialSettings{}.gap,
             py::arg("tilt") = py::none(), words);
  module.def("verify", &check_turn<2>, py::arg("grasp"), py::arg("turn"), words);
  module.def("verify", &check_turn<3>, py::arg("grasp"), py::arg("turn"), words);
}

}  // namespace poise::python
