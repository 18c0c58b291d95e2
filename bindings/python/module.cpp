#include "module.hpp"

#include <utility>

#include "files/file_error.hpp"
#include "poise/grasp.hpp"

namespace py = pybind11;

namespace {

/// Raises one of the exceptions of poise/_errors.py.
template <class... Arguments>
void raise(const char* name, const Arguments&... arguments) {
  const py::object type = py::module_::import("poise._errors").attr(name);
  PyErr_SetObject(type.ptr(), type(arguments...).ptr());
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.doc() = "The library Poise: see the package poise.";
  module.attr("__version__") = POISE_VERSION;
  module.attr("standard_gravity") = poise::standard_gravity;
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(std::move(thrown));
    } catch (const poise::InvalidGrasp& error) {
      raise("InvalidGrasp", error.path(), error.problem());
    } catch (const poise::FileError& error) {
      raise("FileError", error.file(), error.line(), error.column(), error.path(), error.problem());
    }
  });
  poise::python::add_grasp(module);
  poise::python::add_hold(module);
  poise::python::add_curve(module);
  poise::python::add_best(module);
  poise::python::add_capacity(module);
  poise::python::add_motion(module);
  poise::python::add_shake(module);
  poise::python::add_turn(module);
  poise::python::add_verify(module);
  poise::python::add_files(module);
  poise::python::add_batch(module);
}
