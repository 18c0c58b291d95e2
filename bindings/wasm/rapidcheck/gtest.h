// As much of RapidCheck as the tests use, which Debian compiles for the machine alone: random cases
// by a fixed seed, fewer than natively, and no shrinking.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <utility>

namespace rc {

inline constexpr int kNominalSize = 100;
inline constexpr int cases = 200;

inline std::mt19937& random_bits() {
  static std::mt19937 bits(20);
  return bits;
}

template <class Make>
struct Made {
  Make make;
  auto operator*() const { return make(); }
};

/// A generator whose way to make values is forgotten.
template <class T>
struct Gen {
  std::function<T()> make;
  template <class Make>
  Gen(const Made<Make>& made) : make(made.make) {}
  T operator*() const { return make(); }
};

namespace gen {

template <class Make>
Made<Make> exec(Make make) {
  return {std::move(make)};
}

template <class T>
auto inRange(T from, T to) {
  return exec([=] { return std::uniform_int_distribution<T>(from, to - 1)(random_bits()); });
}

template <class Made>
Made resize(int /*size*/, Made made) {
  return made;
}

template <class T, class... Others>
auto element(T first, Others... others) {
  return exec([=] {
    const T all[] = {first, others...};
    return all[*inRange(0, static_cast<int>(1 + sizeof...(others)))];
  });
}

}  // namespace gen

struct Failure {
  const char *what, *file;
  int line;
};

/// Whether all cases pass; says which does not.
template <class Property>
bool check(const Property& property) {
  for (int k = 0; k < cases; ++k) try {
      property();
    } catch (const Failure& failure) {
      ADD_FAILURE() << failure.file << ":" << failure.line << ": case " << k << ": not "
                    << failure.what;
      return false;
    }
  return true;
}

}  // namespace rc

#define RC_ASSERT(...) \
  static_cast<void>((__VA_ARGS__) ? 0 : throw rc::Failure{#__VA_ARGS__, __FILE__, __LINE__})

#define RC_GTEST_PROP(Suite, Name, Arguments)           \
  void rc_##Suite##_##Name Arguments;                   \
  TEST(Suite, Name) { rc::check(rc_##Suite##_##Name); } \
  void rc_##Suite##_##Name Arguments
