// What the user asked for.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <variant>

#include "poise/posture.hpp"

namespace poise {

enum class Command { check, hold, best, curve, view, paper };

/// What `paper` draws beside the paper's own figures; what is not given is that of Fig. 6.
struct PaperArguments {
  std::string out{};                ///< the directory to write to
  std::optional<double> phi_deg{};  ///< above 0, at most 90
  std::optional<double> mu1{}, mu2{};
  double weight{10};  ///< [N]
};

struct Arguments {
  Command command{Command::check};
  std::string file{};
  bool json{false};
  std::optional<double> angle_deg{};  ///< in (-180, 180]
  std::optional<Vector<2>> up{};      ///< as given: of any length but 0
  std::optional<Domain> domain{};
  double force_cap{1e6};              ///< [weights]
  std::optional<std::string> plot{};  ///< the SVG file to draw
  std::string page{};                 ///< the file to write the page to
  PaperArguments paper{};
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
