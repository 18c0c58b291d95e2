#include <H5Cpp.h>

#include <cmath>

#include "readers/regular_file.hpp"

namespace poise::readers {
namespace {

/// A data set that must be there.
H5::DataSet data_set(const H5::H5File& file, const std::string& path) {
  try {
    return file.openDataSet(path);
  } catch (const H5::Exception&) {
    throw ReadError("has no data set " + path + ": it is not a grasp file of ACRONYM");
  }
}

/// Its numbers, of a shape in which a 0 stands for any length.
template <class Number>
std::vector<Number> numbers(const H5::H5File& file, const std::string& path,
                            const std::vector<hsize_t>& shape, const H5::PredType& type) {
  const H5::DataSet set = data_set(file, path);
  const H5::DataSpace space = set.getSpace();
  std::vector<hsize_t> size(static_cast<std::size_t>(space.getSimpleExtentNdims()));
  if (!size.empty()) space.getSimpleExtentDims(size.data());
  bool fits = size.size() == shape.size() && set.getTypeClass() != H5T_STRING;
  std::size_t count = 1;
  for (std::size_t k = 0; fits && k < size.size(); ++k) {
    fits = shape[k] == 0 || shape[k] == size[k];
    count *= size[k];
  }
  if (!fits) throw ReadError("has something else than its numbers in " + path);
  std::vector<Number> values(count);
  set.read(values.data(), type);
  for (const Number& value : values)
    if (!std::isfinite(static_cast<double>(value)))
      throw ReadError("has a number in " + path + " that is not finite");
  return values;
}

double number(const H5::H5File& file, const std::string& path) {
  return numbers<double>(file, path, {}, H5::PredType::NATIVE_DOUBLE).front();
}

double positive(const H5::H5File& file, const std::string& path) {
  const double value = number(file, path);
  if (!(value > 0)) throw ReadError("has no number above 0 in " + path);
  return value;
}

std::string text(const H5::H5File& file, const std::string& path) {
  const H5::DataSet set = data_set(file, path);
  if (set.getTypeClass() != H5T_STRING) throw ReadError("has no text in " + path);
  H5std_string value;
  set.read(value, set.getStrType());
  return value.substr(0, value.find('\0'));  // of fixed length it is padded with zeros
}

AcronymData read(const H5::H5File& file) {
  AcronymData data;
  data.mesh = text(file, "/object/file");
  data.scale = positive(file, "/object/scale");
  data.mass = positive(file, "/object/mass");
  const auto com = numbers<double>(file, "/object/com", {3}, H5::PredType::NATIVE_DOUBLE);
  data.com = Eigen::Vector3d(com.data());
  data.friction = positive(file, "/object/friction");
  data.gripper = text(file, "/gripper/type");
  const auto entries =
      numbers<double>(file, "/grasps/transforms", {0, 4, 4}, H5::PredType::NATIVE_DOUBLE);
  using RowMajor = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  for (std::size_t at = 0; at < entries.size(); at += 16)
    data.transforms.emplace_back(Eigen::Map<const RowMajor>(&entries[at]));
  for (const int held : numbers<int>(file, "/grasps/qualities/flex/object_in_gripper",
                                     {data.transforms.size()}, H5::PredType::NATIVE_INT))
    data.held.push_back(held != 0);
  return data;
}

}  // namespace

AcronymData read_acronym(const std::string& file) {
  check_regular_file(file);
  H5::Exception::dontPrint();
  try {
    return read(H5::H5File(file, H5F_ACC_RDONLY));
  } catch (const H5::FileIException&) {
    throw ReadError("is not a file of HDF5");
  } catch (const H5::Exception& error) {
    throw ReadError("is damaged: " + error.getDetailMsg());
  }
}

}  // namespace poise::readers
