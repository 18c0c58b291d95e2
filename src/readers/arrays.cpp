// HDF5.
#include <H5Cpp.h>

#include <filesystem>

#include "readers/readers.hpp"

namespace poise::readers {
namespace {

void add(const H5::Group& group, const NamedArray& array) {
  const hsize_t size[] = {array.values.size() / array.width, array.width};
  const H5::DataSpace space(array.width > 1 ? 2 : 1, size);
  const H5::DataType type = array.whole ? H5::PredType::STD_I8LE : H5::PredType::IEEE_F64LE;
  const H5::DSetCreatPropList timeless;  // the same numbers make the same file
  H5Pset_obj_track_times(timeless.getId(), false);
  const H5::DataSet set = group.createDataSet(array.name, type, space, timeless);
  set.write(array.values.data(), H5::PredType::NATIVE_DOUBLE);
  for (const auto& [name, text] : array.attributes) {
    const H5::StrType string(H5::PredType::C_S1, std::max<std::size_t>(text.size(), 1));
    set.createAttribute(name, string, H5::DataSpace(H5S_SCALAR)).write(string, text);
  }
}

}  // namespace

void add_arrays(const std::string& file, const std::string& group,
                const std::vector<NamedArray>& arrays) {
  H5::Exception::dontPrint();
  try {
    const bool there = std::filesystem::exists(file);
    const H5::H5File out(file, there ? H5F_ACC_RDWR : H5F_ACC_EXCL);
    const H5::Group into = out.createGroup(group);
    for (const NamedArray& array : arrays) add(into, array);
  } catch (const H5::Exception& error) {
    throw WriteError("cannot be written as HDF5: " + error.getDetailMsg());
  }
}

}  // namespace poise::readers
