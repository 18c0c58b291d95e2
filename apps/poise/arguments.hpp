// What the user asked for.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "poise/posture.hpp"

namespace poise {

enum class Command {
  check,
  contacts,
  hold,
  best,
  curve,
  capacity,
  draw,
  verify,
  batch,
  view,
  import,
  paper
};

/// What `paper` draws beside the paper's own figures; what is not given is that of Fig. 6.
struct PaperArguments {
  std::string out{};                ///< the directory to write to
  std::optional<double> phi_deg{};  ///< above 0, at most 90
  std::optional<double> mu1{}, mu2{};
  double weight{10};  ///< [N]
};

struct BatchArguments {
  std::vector<std::string> inputs{};
  std::string hdf5{};  ///< the file of arrays to write, or ""
  bool hold{false};    ///< one posture instead of the best
  bool resume{false}, strict{false};
};

struct Arguments {
  Command command{Command::check};
  std::string file{};
  std::string result{};  ///< of `verify`: the JSON document to check
  bool json{false};
  std::optional<double> angle_deg{};  ///< in (-180, 180]
  std::vector<double> up{};           ///< as given: 2 or 3 numbers of any length but 0, or none
  std::optional<Domain> domain{};
  double force_cap{1e6};  ///< [weights]
  double safety{1.5};     ///< of `capacity`: on the friction, on top of the file's; at least 1
  // Space.
  std::optional<double> gap{};
  std::optional<int> max_holds{};
  std::optional<Vector<3>> tilt_from{};             ///< unit vector
  std::optional<double> tilt_max_deg{};             ///< 0 to 90
  std::optional<Eigen::Quaterniond> orientation{};  ///< object to world
  std::optional<std::string> plot{};                ///< the SVG file to draw
  std::string page{};                               ///< the file to write the page to
  std::string out{};                                ///< the file to write; "": print it
  std::string mesh_root{};                          ///< of ACRONYM: the folder that has the meshes
  std::size_t grasp{0};                             ///< of `import`: which one of the file
  PaperArguments paper{};
  BatchArguments batch{};
};

/// A command line that makes no sense; what() says why and what would.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The arguments, or the text that was asked for instead of an answer (help, version).
/// @throws UsageError
std::variant<Arguments, std::string> read_arguments(int argc, const char* const* argv);

}  // namespace poise
