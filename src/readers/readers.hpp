// What other files say. urdfdom, Embree and HDF5 take long to load: what needs them stands in
// modules, shared libraries of ours that are loaded when a file first asks for one, so that a
// program that needs none of them starts as fast as ever.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "meshes/formats.hpp"

namespace poise {

/// A path that a file names, seen from where the program runs: it is meant from the file's folder.
std::string path_beside(const std::string& file, const std::string& path);

/// A path as it is named in a file of a folder.
std::string path_from(const std::string& folder, const std::string& path);

/// The triangles of a file (STL, OBJ, PLY or glTF), its polygons cut into triangles, all its meshes
/// where its nodes put them: as they stand there, open or closed, in the unit of the file. All
/// vertices are finite.
/// @throws ReadError
Mesh read_mesh(const std::string& file);

/// Finds triangles along rays, in single precision as seen from the middle of the mesh.
class TriangleFinder {
 public:
  TriangleFinder() = default;
  TriangleFinder(const TriangleFinder&) = delete;
  TriangleFinder& operator=(const TriangleFinder&) = delete;
  virtual ~TriangleFinder() = default;

  /// The index of the triangle that a ray, its direction of length 1, meets first, from either
  /// side.
  virtual std::optional<int> first(const Eigen::Vector3d& origin,
                                   const Eigen::Vector3d& direction) const = 0;
};

/// @throws ReadError where the module cannot be loaded
std::unique_ptr<TriangleFinder> triangle_finder(const Mesh& mesh);

/// The inertial of a link of a robot model, in the link's frame.
struct Inertial {
  double mass{0};                                     ///< [kg], > 0
  Eigen::Vector3d com = Eigen::Vector3d::Zero();      ///< centre of mass [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the com [kg m^2]
};

/// @throws ReadError
Inertial read_inertial(const std::string& urdf, const std::string& link);

/// A file of the ACRONYM data set as it stands: an object and grasps of it.
struct AcronymData {
  std::string mesh{};  ///< "meshes/Mug/10f6....obj", beneath the folder of the data set
  double scale{1};     ///< of the mesh: metres for one of its units
  double mass{0};      ///< [kg]
  Eigen::Vector3d com = Eigen::Vector3d::Zero();  ///< [m], in the frame of the scaled mesh
  double friction{0};
  std::string gripper{};                      ///< "panda"
  std::vector<Eigen::Matrix4d> transforms{};  ///< of the gripper's base, in the scaled mesh frame
  std::vector<bool> held{};                   ///< whether the object stayed in it when shaken
  std::string problem{};  ///< what cannot be read but the transforms; then these alone are there
};

/// @throws ReadError
AcronymData read_acronym(const std::string& file);

/// A file that cannot be written; what() says why, without its name.
class WriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Numbers in rows, with attributes.
struct NamedArray {
  std::string name{};
  std::size_t width{1};  ///< of a row; rows of one number make a list
  std::vector<double> values{};
  std::vector<std::pair<std::string, std::string>> attributes{};
  bool whole{false};  ///< small whole numbers
};

/// Adds a group of arrays to an HDF5 file, which is made if there is none.
/// @throws WriteError
void add_arrays(const std::string& file, const std::string& group,
                const std::vector<NamedArray>& arrays);

}  // namespace poise
