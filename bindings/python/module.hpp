// The parts of the module poise._core, each in a file of its name.
#pragma once

#include <pybind11/pybind11.h>

namespace poise::python {

void add_grasp(pybind11::module_& module);
void add_hold(pybind11::module_& module);
void add_curve(pybind11::module_& module);
void add_best(pybind11::module_& module);
void add_capacity(pybind11::module_& module);
void add_motion(pybind11::module_& module);
void add_shake(pybind11::module_& module);
void add_turn(pybind11::module_& module);
void add_verify(pybind11::module_& module);
void add_batch(pybind11::module_& module);
void add_files(pybind11::module_& module);

}  // namespace poise::python
