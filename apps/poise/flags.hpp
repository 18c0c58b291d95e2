// What a command can be given, and how it is read.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "ask/question.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace poise {

/// A command line that makes no sense; what() says why and what would.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The arguments and flags of one command, which it declares one after the other. Their values are
/// read in this order, once the whole command line has been understood.
class Flags {
 public:
  explicit Flags(CLI::App& app) : app_(app) {}

  /// An argument without a flag, or several. `takes` is what completion offers: "files yaml|json"
  /// or "words one another".
  void argument(const std::string& name, const std::string& help, std::string& value,
                const std::string& takes);
  void arguments(const std::string& name, const std::string& help, std::vector<std::string>& values,
                 const std::string& takes);
  void grasp_file(std::string& file) {
    argument("FILE", "The grasp file", file, "files yaml|yml|json");
  }

  /// A flag with a value, which `read` reads where it is given. By its type, completion knows what
  /// to offer: words "all|pinched", files "SVG|PNG", "FILE" (a grasp file), or folders "DIR".
  Flags& value(const std::string& names, const std::string& type, const std::string& help,
               std::function<void(const std::string&)> read);
  /// A file to write.
  Flags& file(const std::string& names, const std::string& type, const std::string& help,
              std::string& value);
  /// A folder to read from.
  Flags& folder(const std::string& name, const std::string& help, std::string& value);
  /// The flag before must be given.
  void required();
  /// A flag without a value.
  void flag(const std::string& name, const std::string& help, bool& value);
  void json(bool& value) { flag("--json", "Print one JSON document instead of tables", value); }

  // The options of a question.
  void posture(Question& question, const std::string& posture = "Posture");
  void domain(Question& question);
  /// @param sturdy  whether that can be asked for, too
  void objective(Question& question, bool sturdy = false);
  void force_cap(Question& question);
  /// Domain, objective, force cap, gap, holds: of the best posture, or of turns, with their
  /// defaults.
  void search(Question& question, bool sturdy = false);
  void turned(Question& question);  ///< tilt, orientation

  /// @throws UsageError
  void read() const;

  const CLI::App& app() const { return app_; }
  /// What completion offers for each argument, in their order.
  const std::vector<std::string>& takes() const { return takes_; }

 private:
  CLI::App& app_;
  CLI::Option* last_{nullptr};
  std::vector<std::function<void()>> readers_{};
  std::vector<std::string> takes_{};
};

// Values of flags, from their texts; the flag's name is for messages.
// @throws UsageError

/// A finite number, and nothing after it.
std::optional<double> parsed_number(std::string_view text);
/// A number in a range, or any; in words what it `must_be`.
double read_number(const std::string& flag, const std::string& text, const std::string& must_be,
                   bool (*in_range)(double) = nullptr);
/// Numbers between commas, not all 0, as many as in one of the examples.
std::vector<double> read_direction(const std::string& flag, const std::string& text,
                                   std::size_t least, std::size_t most,
                                   const std::string& examples);
/// w first; made a unit quaternion.
Eigen::Quaterniond read_quaternion(const std::string& flag, const std::string& text);

/// A text in quotes, fit for a message.
std::string in_quotes(const std::string& text);

}  // namespace poise
