// Grasp files, as Python has them.
#pragma once

#include <pybind11/pybind11.h>

#include "files/grasp_file.hpp"

namespace poise::python {

/// A GraspFile of poise/_files.py.
pybind11::object write(const GraspFile& file);

}  // namespace poise::python
