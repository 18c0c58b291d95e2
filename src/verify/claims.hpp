// What a result claims, and how far each claim is from the truth.
#pragma once

#include <string>
#include <vector>

#include "files/field.hpp"

namespace poise::verify {

using Real = long double;

/// The same claim, made once or at many places.
struct Check {
  std::string words;  ///< what is claimed
  std::string where;  ///< "minima[*].contacts[*]"
  int times{0};
  Real off{0}, allowed{0};  ///< where it is closest to being refuted
  std::string closest{};    ///< that place: "minima[1].contacts[0]"
};

struct Refutation {
  std::string words, path;
  int line{0};
  Real off{0}, allowed{0};
};

/// All the claims that have been checked.
class Claims {
 public:
  /// A claim at some place in the result, true if `off` is at most `allowed`.
  void check(const Field& at, const std::string& words, Real off, Real allowed);
  /// One that is either true or not.
  void check(const Field& at, const std::string& words, bool right);
  /// What is not claimed or cannot be checked, for people to know.
  void note(const std::string& words);

  const std::vector<Check>& checks() const { return checks_; }
  const std::vector<Refutation>& refutations() const { return refutations_; }
  const std::vector<std::string>& notes() const { return notes_; }
  bool confirmed() const { return refutations_.empty(); }

 private:
  std::vector<Check> checks_{};
  std::vector<Refutation> refutations_{};
  std::vector<std::string> notes_{};
};

/// |a - b| relative to the larger; 0 where they are the same.
Real difference(Real a, Real b);

}  // namespace poise::verify
