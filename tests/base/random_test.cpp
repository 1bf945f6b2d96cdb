#include "base/random.hpp"

#include <gtest/gtest.h>

namespace base {
namespace {

// Random numbers must never change, because published results depend on them.
TEST(Random, StreamsStayTheSame) {
  EXPECT_EQ(random_at(0, 0), 16294208416658607535u);  // first number of SplitMix64 for the seed 0
  EXPECT_EQ(Random(5489).uniform(),
            (static_cast<double>(14514284786278117030u >> 11) + 0.5) * 0x1p-53);
}

TEST(Random, RangesAreKept) {
  Random random(1, 3);
  for (int i = 0; i < 1000; ++i) {
    const double uniform = random.uniform();
    EXPECT_TRUE(uniform > 0 && uniform < 1);
    const int other = random.other_than(2, 5);
    EXPECT_TRUE(other >= 0 && other < 5 && other != 2);
  }
}

}  // namespace
}  // namespace base
