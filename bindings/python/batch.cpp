#include "batch/record.hpp"
#include "module.hpp"
#include "values.hpp"

namespace poise::python {
namespace {

std::string answer(const std::string& text, std::size_t record, bool hold,
                   std::optional<double> angle_deg, const std::vector<double>& up,
                   std::optional<Domain> domain, double force_cap, std::optional<double> gap,
                   std::optional<int> max_holds) {
  if (up.size() == 1 || up.size() > 3) throw InvalidGrasp("up", "must have 2 or 3 numbers");
  if (std::any_of(up.begin(), up.end(), [](double x) { return !std::isfinite(x); }) ||
      (!up.empty() && std::all_of(up.begin(), up.end(), [](double x) { return x == 0; })))
    throw InvalidGrasp("up", "must be a direction");
  const Question question{.hold = hold,
                          .angle_deg = angle_deg,
                          .up = up,
                          .domain = domain,
                          .force_cap = checked_cap(force_cap),
                          .gap = gap,
                          .max_holds = max_holds};
  const py::gil_scoped_release unlocked;
  return answer_record(
             {.record = record}, [&] { return grasp_of_line(text); }, question)
      .line;
}

}  // namespace

void add_batch(py::module_& module) {
  module.def("answer_record", &answer, py::arg("text"), py::arg("record"), py::kw_only(),
             py::arg("hold") = false, py::arg("angle_deg") = py::none(),
             py::arg("up") = std::vector<double>(), py::arg("domain") = py::none(),
             py::arg("force_cap") = 1e6, py::arg("gap") = py::none(),
             py::arg("max_holds") = py::none(),
             "The line of JSON, with its line end, that poise batch writes for a line of its "
             "input, a grasp\nin JSON; record is its number. The options are those of poise "
             "batch.");
}

}  // namespace poise::python
