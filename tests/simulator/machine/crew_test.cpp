#include "simulator/machine/crew.hpp"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace machine {
namespace {

// In each round, exactly the threads that are called must do their share once, before work()
// returns.
TEST(Crew, DoesTheSharesOfThoseCalled) {
  for (const std::size_t size : {1, 2, 3, 8}) {
    std::vector<int> done(size);
    std::vector<std::thread::id> where(size);
    Crew crew(size, [&](std::size_t number) {
      ++done[number];
      if (done[number] == 1) where[number] = std::this_thread::get_id();
      if (where[number] != std::this_thread::get_id()) done[number] = -1;
    });
    std::mt19937_64 random(size);
    std::vector<int> asked(size);
    for (int round = 0; round < 500; ++round) {
      std::vector<std::size_t> members;
      for (std::size_t number = 0; number < size; ++number)
        if (random() % 2 == 0) members.push_back(number);
      for (const std::size_t number : members) ++asked[number];
      crew.work(members);
      ASSERT_EQ(done, asked) << "size " << size << ", round " << round;
    }
    EXPECT_EQ(where[0], std::this_thread::get_id());
  }
}

TEST(Crew, ThrowsWhatAShareHasThrown) {
  bool throws = true;
  Crew crew(3, [&](std::size_t number) {
    if (throws && number == 2) throw std::runtime_error("so");
  });
  EXPECT_THROW(crew.work({0, 1, 2}), std::runtime_error);
  throws = false;
  crew.work({2});
}

}  // namespace
}  // namespace machine
