// Holding with up to 16 contacts allocates nothing on the heap.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <random>

#include "poise/posture.hpp"

namespace {
volatile std::size_t allocations = 0;  // compilers think that malloc changes nothing
}

// Linked with --wrap=malloc: counts what the library and Eigen ask of malloc itself.
extern "C" {
void* __real_malloc(std::size_t size);
void* __wrap_malloc(std::size_t size) {
  allocations = allocations + 1;
  return __real_malloc(size);
}
}

void* operator new(std::size_t size) {
  allocations = allocations + 1;
  if (void* memory = __real_malloc(size)) return memory;
  throw std::bad_alloc();
}
// Not inlined, since g++ takes them for a mistake beside an operator new that it does not inline.
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace poise::test {
namespace {

/// A disk with fingers all round; every second grasp with limits.
Grasp<2> random_grasp(std::mt19937& random, std::size_t contacts) {
  std::uniform_real_distribution<double> angle(-3.1, 3.1), part(0, 1);
  std::vector<Contact<2>> result(contacts);
  const bool limits = random() % 2 == 0;
  for (Contact<2>& contact : result) {
    const double at = angle(random);
    contact.position = {std::cos(at), std::sin(at)};
    contact.normal = -contact.position;
    contact.friction = part(random);
    if (limits) contact.min_normal = part(random) / 4;
    if (limits) contact.max_normal = 1 + part(random);
  }
  return Grasp<2>({1, {part(random) / 4, 0}}, result);
}

template <class Function>
std::size_t allocations_of(const Function& function) {
  const std::size_t before = allocations;
  function();
  return allocations - before;
}

TEST(Allocation, IsCounted) {
  void* volatile memory = nullptr;  // that it is used keeps the compiler from leaving it out
  EXPECT_EQ(allocations_of([&] { memory = std::malloc(1); }), 1U);
  std::free(memory);
  EXPECT_EQ(allocations_of([&] { memory = ::operator new(1); }), 1U);
  ::operator delete(memory);
  Eigen::VectorXd vector;
  EXPECT_EQ(allocations_of([&] { vector.resize(100); }), 1U);
}

TEST(Allocation, OfHoldsWithUpTo16ContactsIsNone) {
  std::mt19937 random(1);
  int held = 0, unholdable = 0;
  for (int round = 0; round < 1000; ++round) {
    const Grasp<2> grasp = random_grasp(random, 1 + random() % 16);
    const double theta = std::uniform_real_distribution<double>(-3.1, 3.1)(random);
    const Vector<2> up = up_at(theta);
    Hold<2> cold, warm;
    ASSERT_EQ(allocations_of([&] { cold = hold(grasp, up); }), 0U);
    ASSERT_EQ(allocations_of([&] {
                warm = hold<2>(grasp, grasp.loads().front().at(up_at(theta + 0.01)), grasp.size(),
                               cold.dual);
              }),
              0U);
    ++(cold.holdable ? held : unholdable);
  }
  EXPECT_GT(held, 100);
  EXPECT_GT(unholdable, 100);
}

TEST(Allocation, OfCopiesOfSuchHoldsIsNone) {
  std::mt19937 random(2);
  const Hold<2> original = hold(random_grasp(random, 16), up_at(0));
  EXPECT_EQ(allocations_of([&] {
              Hold<2> copy = original;
              const Hold<2> moved = std::move(copy);
              EXPECT_EQ(moved.forces.size(), original.forces.size());
            }),
            0U);
}

TEST(Allocation, OfHoldsInSpaceIsNone) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> part(-1, 1);
  const auto direction = [&] {
    return Vector<3>(part(random), part(random), part(random)).normalized();
  };
  int held = 0, unholdable = 0;
  for (int round = 0; round < 500; ++round) {
    std::vector<Contact<3>> contacts(1 + random() % 16);
    for (Contact<3>& contact : contacts) {
      contact.position = direction();
      contact.normal = -contact.position;
      contact.friction = 0.5 + part(random) / 2;
      if (random() % 2 == 0) contact.torsion = 0.1;
      if (random() % 4 == 0) contact.max_normal = 1.5 + part(random);
    }
    const Grasp<3> grasp({1, 0.2 * direction()}, contacts);
    const Vector<3> up = direction();
    Hold<3> found;
    ASSERT_EQ(allocations_of([&] { found = hold(grasp, up); }), 0U);
    ++(found.holdable ? held : unholdable);
  }
  EXPECT_GT(held, 100);
  EXPECT_GT(unholdable, 20);
}

TEST(Allocation, OfMoreContactsIsAllowed) {
  std::mt19937 random(3);
  const Grasp<2> grasp = random_grasp(random, 40);
  const Hold<2> found = hold(grasp, up_at(0));
  EXPECT_TRUE(!found.holdable || found.forces.size() == 40U);
}

}  // namespace
}  // namespace poise::test
