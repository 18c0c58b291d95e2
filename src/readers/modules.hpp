// What the modules offer to load.cpp: one table each.
#pragma once

#include "readers/readers.hpp"

namespace poise {

/// urdfdom and Embree.
struct MeshModule {
  Inertial (*inertial)(const std::string& xml, const std::string& link);
  decltype(&triangle_finder) finder;
};

/// HDF5.
struct DataModule {
  decltype(&read_acronym) acronym;
  decltype(&poise::add_arrays) add_arrays;
};

}  // namespace poise
