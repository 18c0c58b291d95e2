// What an answer claims, and how far each claim is from the truth.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace poise::verify {

using Real = long double;

/// Where a claim stands in the document of an answer: "minima[1].contacts[0]".
class Path {
 public:
  Path operator/(std::string_view key) const {
    return Path((text_.empty() ? "" : text_ + ".") + std::string(key));
  }
  Path operator[](std::size_t index) const {
    return Path(text_ + "[" + std::to_string(index) + "]");
  }
  const std::string& text() const { return text_; }
  Path() = default;

 private:
  explicit Path(std::string text) : text_(std::move(text)) {}
  std::string text_{};
};

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
  Real off{0}, allowed{0};
};

/// What nobody has checked, at one or many places.
struct Unchecked {
  std::string where;  ///< "minima[*].reason"
  std::string words;  ///< why
};

/// All the claims that have been checked.
class Verdict {
 public:
  /// A claim at some place in the document, true if `off` is at most `allowed`.
  void check(const Path& place, const std::string& words, Real off, Real allowed);
  /// One that is either true or not.
  void check(const Path& place, const std::string& words, bool right);
  /// What is claimed there, or below, and cannot be checked.
  void unchecked(const Path& place, const std::string& words);
  /// What is not claimed, for people to know.
  void note(const std::string& words);
  /// The same, where it is what was asked for.
  void leave_open(const std::string& words) {
    note(words);
    open_ = true;
  }

  const std::vector<Check>& checks() const { return checks_; }
  const std::vector<Refutation>& refutations() const { return refutations_; }
  const std::vector<Unchecked>& unchecked() const { return unchecked_; }
  const std::vector<std::string>& notes() const { return notes_; }
  bool confirmed() const { return refutations_.empty(); }
  /// Whether the document itself says that its answer is not known.
  bool is_open() const { return open_; }

 private:
  std::vector<Check> checks_{};
  std::vector<Refutation> refutations_{};
  std::vector<Unchecked> unchecked_{};
  std::vector<std::string> notes_{};
  bool open_{false};
};

/// What was refuted, a line each; empty where all was confirmed.
std::string refutations_text(const Verdict& verdict);

/// |a - b| relative to the larger; 0 where they are the same.
Real difference(Real a, Real b);

}  // namespace poise::verify
