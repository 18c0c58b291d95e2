// One grasp of many, answered in one line of JSON.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "ask/question.hpp"
#include "data/acronym.hpp"
#include "files/grasp_file.hpp"

namespace poise {

enum class Outcome {
  answered,
  unholdable,  ///< nothing that holds was found
  bad,         ///< a grasp that has no meaning
};

struct Record {
  std::string line;  ///< with its line end
  Outcome outcome{Outcome::bad};
};

/// Which record it is.
struct RecordKey {
  std::size_t record{0};
  std::string file{};                  ///< where each grasp is in a file of its own, or ""
  std::optional<std::size_t> grasp{};  ///< where a file has many
};

/// The answer to a grasp, or, where reading it throws FileError, what is wrong with it. The words
/// are those of `poise best --json` and `poise hold --json`, without proofs and contacts.
/// @param question  its command is best or hold
Record answer_record(const RecordKey& key, const std::function<GraspFile()>& read,
                     const Question& question);

/// The grasp in a line of JSON Lines, at most longest_line long.
/// @throws FileError
GraspFile grasp_of_line(const std::string& line);
inline constexpr std::size_t longest_line = 1 << 20;  ///< as for a grasp file

/// A grasp of the ACRONYM data set, and its key without a number.
/// @throws FileError also where the hand misses the object
GraspFile grasp_of_acronym(const Acronym& data, std::size_t n);
RecordKey key_of_acronym(const std::string& file, std::size_t n);

/// The outcome that a record tells, or none if the line is no record.
std::optional<Outcome> outcome_of(const std::string& line);

}  // namespace poise
