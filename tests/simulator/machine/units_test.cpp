// Rounding to whole cycles.
#include "simulator/machine/units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace machine {
namespace {

// Tests numbers halfway between two whole numbers, and the numbers next to them, of all magnitudes.
TEST(Units, CyclesAreRoundedAsTheStandardLibraryDoes) {
  constexpr unsigned SEED = 20;
  std::mt19937_64 random(SEED);
  for (int bits = 0; bits <= 50; ++bits)
    for (int i = 0; i < 200; ++i) {
      const double half = 0.5 * std::floor(std::ldexp(static_cast<double>(random()), bits - 64));
      for (const double x : {half, std::nextafter(half, 0), std::nextafter(half, 2 * half + 1)})
        for (const double cycles : {x, -x})
          ASSERT_EQ(round_to_cycles(cycles).value, std::llround(cycles))
              << cycles << ", seed " << SEED;
    }
}

}  // namespace
}  // namespace machine
