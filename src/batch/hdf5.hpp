// Records of ACRONYM grasps as arrays beside those of the data set.
#pragma once

#include <string>

namespace poise {

/// Puts the records of a finished run into an HDF5 file: for each data file a group, named after it
/// without its folder and its .h5, whose arrays are in the order of its /grasps/transforms and as
/// long; none for a file of which these cannot be read. The file appears when it is whole.
/// @param records  JSON Lines; the arrays of one data file at a time are in memory
/// @throws FileError where it cannot be written
void write_hdf5(const std::string& records, const std::string& path);

}  // namespace poise
