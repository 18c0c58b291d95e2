#include "verify/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

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

void Verdict::check(const Path& place, const std::string& words, Real off, Real allowed) {
  off = std::max(off, Real{0});  // the right side of a bound; nan stays
  const std::string where = pattern(place.text());
  auto check = std::find_if(checks_.begin(), checks_.end(),
                            [&](const Check& c) { return c.words == words && c.where == where; });
  if (check == checks_.end())
    check = checks_.insert(checks_.end(), {.words = words, .where = where});
  if (check->times++ == 0 || !(used(off, allowed) <= used(check->off, check->allowed))) {
    check->off = off;
    check->allowed = allowed;
    check->closest = place.text();
  }
  if (!(off <= allowed)) refutations_.push_back({words, place.text(), off, allowed});
}

void Verdict::check(const Path& place, const std::string& words, bool right) {
  check(place, words, right ? 0 : 1, 0);
}

void Verdict::unchecked(const Path& place, const std::string& words) {
  const std::string where = pattern(place.text());
  if (std::none_of(unchecked_.begin(), unchecked_.end(),
                   [&](const Unchecked& each) { return each.where == where; }))
    unchecked_.push_back({where, words});
}

void Verdict::note(const std::string& words) {
  if (std::find(notes_.begin(), notes_.end(), words) == notes_.end()) notes_.push_back(words);
}

std::string refutations_text(const Verdict& verdict) {
  std::ostringstream text;
  for (const Refutation& each : verdict.refutations())
    text << each.path << ": " << each.words << ": " << each.off << " of " << each.allowed << "\n";
  return text.str();
}

Real difference(Real a, Real b) {
  return a == b ? 0 : std::abs(a - b) / std::max(std::abs(a), std::abs(b));
}

}  // namespace poise::verify
