// Grasps of the ACRONYM data set (Eppner, Mousavian, Fox 2021), as grasp files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files/grasp_file.hpp"
#include "gripper/surface.hpp"
#include "readers/readers.hpp"

namespace poise {

/// A file of the data set: an object, and how a Panda hand takes it. It is opened, its mesh is read
/// and prepared for rays once; then each grasp costs a few microseconds. Functions that do not
/// change it may run at once in several threads.
class Acronym {
 public:
  /// @param mesh_root  the folder beneath which the file names its mesh: meshes/Mug/10f6....obj
  /// @throws FileError where not even the number of its grasps can be read
  Acronym(const std::string& file, const std::string& mesh_root);

  std::size_t size() const { return data_.transforms.size(); }  ///< how many grasps

  /// Whether the object stayed in the hand when it was shaken, in the simulation of the data set.
  /// False where that cannot be read.
  bool held(std::size_t n) const { return n < data_.held.size() && data_.held[n]; }

  /// Grasp n, 0 <= n < size(), in the frame of the scaled mesh, with the hand as `gripper` and the
  /// contacts that it makes; weight and com as the data set has them.
  /// @throws MissedGrip where the pads touch nothing, or begin inside the object
  /// @throws FileError where its pose is none, or the object or its mesh cannot be read
  SpatialFile grasp(std::size_t n) const;

 private:
  std::string file_;
  AcronymData data_;
  std::vector<std::string> notes_{};    ///< what was mended in the mesh
  std::optional<FileError> problem_{};  ///< of all its grasps
  Solid shape_{};
  std::optional<Surface> surface_{};
};

}  // namespace poise
