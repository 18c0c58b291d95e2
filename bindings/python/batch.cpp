#include <algorithm>
#include <cmath>

#include "ask/question.hpp"
#include "batch/record.hpp"
#include "files.hpp"
#include "module.hpp"
#include "values.hpp"

namespace poise::python {
namespace {

Question question(bool hold, std::optional<double> angle_deg, const std::vector<double>& up,
                  std::optional<Domain> domain, double force_cap, std::optional<double> gap,
                  std::optional<int> max_holds) {
  if (up.size() == 1 || up.size() > 3) throw InvalidGrasp("up", "must have 2 or 3 numbers");
  if (std::any_of(up.begin(), up.end(), [](double x) { return !std::isfinite(x); }) ||
      (!up.empty() && std::all_of(up.begin(), up.end(), [](double x) { return x == 0; })))
    throw InvalidGrasp("up", "must be a direction");
  return {.command = hold ? Command::hold : Command::best,
          .angle_deg = angle_deg,
          .up = up,
          .domain = domain,
          .force_cap = checked_cap(force_cap),
          .gap = gap,
          .max_holds = max_holds};
}

/// A file of the data set, and its name in records.
struct AcronymFile {
  std::string file;
  Acronym data;
};

std::size_t checked(const AcronymFile& file, std::size_t n) {
  if (n >= file.data.size()) throw py::index_error("no such grasp");
  return n;
}

/// A function that takes a question by keywords, after the arguments of `answer`.
template <class... Arguments, class Answer, class... Extra>
void define(auto& scope, const char* name, Answer answer, const Extra&... extra) {
  scope.def(
      name,
      [answer](Arguments... arguments, bool hold, std::optional<double> angle_deg,
               const std::vector<double>& up, std::optional<Domain> domain, double force_cap,
               std::optional<double> gap, std::optional<int> max_holds) {
        const Question asked = question(hold, angle_deg, up, domain, force_cap, gap, max_holds);
        const py::gil_scoped_release unlocked;
        return answer(arguments..., asked).line;
      },
      extra..., py::kw_only(), py::arg("hold") = false, py::arg("angle_deg") = py::none(),
      py::arg("up") = std::vector<double>(), py::arg("domain") = py::none(),
      py::arg("force_cap") = 1e6, py::arg("gap") = py::none(), py::arg("max_holds") = py::none());
}

}  // namespace

void add_batch(py::module_& module) {
  define<const std::string&, std::size_t>(
      module, "answer_record",
      [](const std::string& text, std::size_t record, const Question& asked) {
        return answer_record(
            {.record = record}, [&] { return grasp_of_line(text); }, asked);
      },
      "The line of JSON, with its line end, that poise batch writes for a line of its input, a\n"
      "grasp in JSON; record is its number. The options are those of poise batch.",
      py::arg("text"), py::arg("record"));

  py::class_<AcronymFile> acronym(
      module, "Acronym",
      "A file of the ACRONYM data set; mesh_root is the folder that has its meshes/. Raises\n"
      "FileError.");
  acronym
      .def(py::init([](const std::string& file, const std::string& mesh_root) {
             return AcronymFile{file, {file, mesh_root}};
           }),
           py::arg("file"), py::arg("mesh_root"))
      .def("__len__", [](const AcronymFile& file) { return file.data.size(); })
      .def(
          "grasp",
          [](const AcronymFile& file, std::size_t n) {
            return write(grasp_of_acronym(file.data, checked(file, n)));
          },
          py::arg("n"),
          "Grasp n, from 0, as poise import makes it, with the contacts of the hand. Raises "
          "FileError,\nalso where the hand misses the object.")
      .def(
          "held",
          [](const AcronymFile& file, std::size_t n) { return file.data.held(checked(file, n)); },
          py::arg("n"),
          "Whether grasp n held the object when it was shaken, in the simulation of the data set.");
  define<const AcronymFile&, std::size_t, std::size_t>(
      acronym, "answer_record",
      [](const AcronymFile& file, std::size_t grasp, std::size_t record, const Question& asked) {
        RecordKey key = key_of_acronym(file.file, grasp);
        key.record = record;
        return answer_record(
            key, [&] { return grasp_of_acronym(file.data, grasp); }, asked);
      },
      "The line that poise batch writes for a grasp of the file, from 0; see answer_record.",
      py::arg("grasp"), py::arg("record"));
}

}  // namespace poise::python
