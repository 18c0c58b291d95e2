// Many grasps on all cores.
#pragma once

#include <functional>

#include "batch/inputs.hpp"
#include "batch/output.hpp"

namespace poise {

/// How many records there are of each outcome.
struct Counts {
  std::size_t answered{0}, unholdable{0}, bad{0};
  void add(Outcome outcome);
  std::size_t all() const { return answered + unholdable + bad; }
};

/// A bad record where none may be; what() is its line.
class BadRecord : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Answers what is left of the inputs, in their order, and adds it to the output. The memory that
/// it takes does not depend on how many there are.
/// @param counts    of the records that are there already; those of the new ones are added
/// @param strict    a bad record ends it
/// @param progress  called after each record, one at a time
/// @throws FileError where the output cannot be written, BadRecord
void answer_all(Inputs& inputs, const Question& question, Output& output, Counts& counts,
                bool strict, const std::function<void(const Counts&)>& progress);

}  // namespace poise
