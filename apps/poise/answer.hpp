// A question about a grasp file, answered in words or as a document.
#pragma once

#include <memory>
#include <string>

#include "ask/ask.hpp"
#include "commands.hpp"

namespace poise {

/// Prints what is doubtful about a file on standard error.
void warn(const std::vector<std::string>& warnings);

/// What of a question does not fit a file, in words.
UsageError usage_error(const Misfit& misfit, const std::string& file);

/// What `f(file, grasp)` makes of a grasp file, in the plane or in space.
template <class F>
auto with_grasp(const std::string& file, const F& f) {
  try {
    return std::visit([&](const auto& read) { return f(read, read.grasp()); },
                      read_grasp_file(file));
  } catch (const Misfit& misfit) {
    throw usage_error(misfit, file);
  }
}

/// What is asked of a grasp file, and how it is to be answered.
struct Asked {
  std::string file{};
  bool json{false};
  Question question{};
};

/// Of a command that asks: with the file, and --json, already declared.
std::shared_ptr<Asked> declare_question(Flags& flags, Command command);

/// The answer, as a table or a document.
Reply answer(const Asked& asked);
/// The same where the file has been read. @throws Misfit
Reply answer(const Asked& asked, const PlanarFile& file, const Grasp<2>& grasp);
Reply answer(const Asked& asked, const SpatialFile& file, const Grasp<3>& grasp);

}  // namespace poise
