// Many grasps, one after the other: JSON Lines, a folder of grasp files, or the ACRONYM data set.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "batch/record.hpp"

namespace poise {

/// A grasp that is not read yet; reading it throws FileError where it is bad.
struct Unread {
  RecordKey key;
  std::function<GraspFile()> read;
};

class Inputs {
 public:
  virtual ~Inputs() = default;
  /// The next grasp, or none at the end; its key has no number yet. Cheap: what takes time is done
  /// by Unread::read.
  virtual std::optional<Unread> next() = 0;
  /// How much of it has been handed out, 0 to 1; below 0 where that is not known.
  virtual double part() const = 0;
  /// What changes when the grasps do, as far as that can be told without reading them.
  virtual nlohmann::ordered_json identity() const = 0;
};

/// One after the other.
/// @param paths  each a file of JSON Lines, "-" for standard input, or a folder, of whose files
///               those that end in .yaml, .yml and .json and are not hidden are taken in the order
///               of their names, or a file of the ACRONYM data set, which ends in .h5
/// @param mesh_root  the folder that has the meshes/ of the data set
/// @throws FileError for what cannot be opened, and for a folder without grasp files
std::unique_ptr<Inputs> open_inputs(const std::vector<std::string>& paths,
                                    const std::string& mesh_root);

}  // namespace poise
