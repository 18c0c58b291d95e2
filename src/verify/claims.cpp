#include "verify/claims.hpp"

#include <algorithm>
#include <cmath>

namespace poise::verify {
namespace {

/// A path without its indices.
std::string pattern(const std::string& path) {
  std::string result;
  bool index = false;
  for (const char c : path) {
    if (c == ']') index = false;
    if (!index) result += c;
    if (c == '[') {
      index = true;
      result += '*';
    }
  }
  return result;
}

/// How much of what is allowed is used.
Real used(Real off, Real allowed) { return allowed > 0 ? off / allowed : off > 0 ? 2 : 0; }

}  // namespace

void Claims::check(const Field& at, const std::string& words, Real off, Real allowed) {
  off = std::max(off, Real{0});  // the right side of a bound; nan stays
  const std::string where = pattern(at.path());
  auto check = std::find_if(checks_.begin(), checks_.end(),
                            [&](const Check& c) { return c.words == words && c.where == where; });
  if (check == checks_.end())
    check = checks_.insert(checks_.end(), {.words = words, .where = where});
  if (check->times++ == 0 || !(used(off, allowed) <= used(check->off, check->allowed))) {
    check->off = off;
    check->allowed = allowed;
    check->closest = at.path();
  }
  if (!(off <= allowed)) refutations_.push_back({words, at.path(), at.place().line, off, allowed});
}

void Claims::check(const Field& at, const std::string& words, bool right) {
  check(at, words, right ? 0 : 1, 0);
}

void Claims::note(const std::string& words) {
  if (std::find(notes_.begin(), notes_.end(), words) == notes_.end()) notes_.push_back(words);
}

Real difference(Real a, Real b) {
  return a == b ? 0 : std::abs(a - b) / std::max(std::abs(a), std::abs(b));
}

}  // namespace poise::verify
