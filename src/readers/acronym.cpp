#include <H5Cpp.h>

#include <cmath>

#include "readers/readers.hpp"

namespace poise::readers {
namespace {

constexpr hsize_t most_grasps = 1'000'000;
constexpr std::size_t longest_text = 4096;

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
    if (size[k] > most_grasps)
      throw ReadError("has " + std::to_string(size[k]) + " of " + path + ", at most " +
                      std::to_string(most_grasps) + " are read");
    count *= size[k];
  }
  if (!fits) throw ReadError("has something else than its numbers in " + path);
  std::vector<Number> values(count);
  set.read(values.data(), type);
  return values;
}

double number(const H5::H5File& file, const std::string& path) {
  const double value = numbers<double>(file, path, {}, H5::PredType::NATIVE_DOUBLE).front();
  if (!std::isfinite(value)) throw ReadError("has a number in " + path + " that is not finite");
  return value;
}

double positive(const H5::H5File& file, const std::string& path) {
  const double value = number(file, path);
  if (!(value > 0)) throw ReadError("has no number above 0 in " + path);
  return value;
}

std::string text(const H5::H5File& file, const std::string& path) {
  const H5::DataSet set = data_set(file, path);
  if (set.getTypeClass() != H5T_STRING || set.getSpace().getSimpleExtentNpoints() != 1 ||
      set.getStrType().getSize() > longest_text)
    throw ReadError("has no text in " + path);
  H5std_string value;
  set.read(value, set.getStrType());
  return value.substr(0, value.find('\0'));  // of fixed length it is padded with zeros
}

void read_object(const H5::H5File& file, AcronymData& data) {
  data.mesh = text(file, "/object/file");
  data.scale = positive(file, "/object/scale");
  data.mass = positive(file, "/object/mass");
  const auto com = numbers<double>(file, "/object/com", {3}, H5::PredType::NATIVE_DOUBLE);
  data.com = Eigen::Vector3d(com.data());
  if (!data.com.allFinite()) throw ReadError("has a number in /object/com that is not finite");
  data.friction = positive(file, "/object/friction");
  data.gripper = text(file, "/gripper/type");
  for (const int held : numbers<int>(file, "/grasps/qualities/flex/object_in_gripper",
                                     {data.transforms.size()}, H5::PredType::NATIVE_INT))
    data.held.push_back(held != 0);
}

AcronymData read(const H5::H5File& file) {
  AcronymData data;
  const auto entries =
      numbers<double>(file, "/grasps/transforms", {0, 4, 4}, H5::PredType::NATIVE_DOUBLE);
  using RowMajor = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  for (std::size_t at = 0; at < entries.size(); at += 16)
    data.transforms.emplace_back(Eigen::Map<const RowMajor>(&entries[at]));
  try {
    read_object(file, data);
  } catch (const ReadError& error) {
    data.problem = error.what();
  } catch (const H5::Exception& error) {
    data.problem = "is damaged: " + error.getDetailMsg();
  }
  return data;
}

}  // namespace

AcronymData read_acronym(const std::string& file) {
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
