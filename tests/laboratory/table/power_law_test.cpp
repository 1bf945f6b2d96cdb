// Bends of curves: power laws whose exponent changes, with noise and without.
#include "experiments/laboratory/table/power_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "experiments/laboratory/table/laws.hpp"

namespace laboratory {
namespace {

using Values = std::vector<double>;

TEST(ExperimentsGrowth, BrokenPowersAreFoundAgain) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    const auto choose = [&](double low, double high) {
      return std::uniform_real_distribution(low, high)(random);
    };
    const std::size_t points = 5 + seed % 8, bend = 2 + seed % (points - 4);
    const double before = choose(-2, 2), noise = seed % 2 ? 0.001 : 0;
    const double change = choose(0.3, 2) * (seed % 3 ? 1 : -1), scale = choose(1e-6, 1e6);
    Values x, y;
    for (std::size_t i = 0; i < points; ++i) x.push_back((i ? x.back() : 1) * choose(1.5, 3));
    for (const double at : x)
      y.push_back(scale * std::pow(at, before) * std::pow(std::max(1.0, at / x[bend]), change) *
                  std::exp(choose(-noise, noise)));
    const auto growth = fit_power_law(x, y);
    ASSERT_TRUE(growth && growth->bend) << "seed " << seed;
    EXPECT_EQ(*growth->bend, x[bend]) << "seed " << seed;
    EXPECT_NEAR(growth->before, before, 1e-6 + 10 * noise) << "seed " << seed;
    EXPECT_NEAR(growth->after, before + change, 1e-6 + 10 * noise) << "seed " << seed;
  }
}

TEST(ExperimentsGrowth, PowersHaveNoBend) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution exponent(-3.0, 3.0), noise(-0.01, 0.01);
    const double power = exponent(random);
    Values x, y;
    for (int i = 0; i < 5 + int(seed % 8); ++i) {
      x.push_back(std::exp2(i));
      y.push_back(7 * std::pow(x.back(), power) * std::exp(seed % 2 ? noise(random) : 0));
    }
    const auto growth = fit_power_law(x, y);
    ASSERT_TRUE(growth) << "seed " << seed;
    EXPECT_FALSE(growth->bend) << "seed " << seed;
    EXPECT_NEAR(growth->before, power, 0.02) << "seed " << seed;
    EXPECT_EQ(growth->before, growth->after);
  }
}

// With a serial fraction s, 1/s processors reach about half of the largest speed-up that Amdahl's
// law permits.
TEST(ExperimentsGrowth, AmdahlsLawBendsNearOneOverItsSerialFraction) {
  Values x, y;
  for (int n = 1; n <= 1024; n *= 2) x.push_back(n);
  for (const double n : x) y.push_back(amdahl_speedup(1.0 / 32, n));
  const auto growth = fit_power_law(x, y);
  ASSERT_TRUE(growth && growth->bend);
  EXPECT_GE(*growth->bend, 16);
  EXPECT_LE(*growth->bend, 64);
  EXPECT_GT(growth->before, 0.8);
  EXPECT_LT(growth->after, 0.2);
}

TEST(ExperimentsGrowth, FewPointsAndNumbersWithoutLogarithmsSayNothing) {
  const Values x = {1, 2, 3, 4, 5};
  EXPECT_TRUE(fit_power_law(x, {1, 1, 1, 1, 1}));
  EXPECT_FALSE(fit_power_law({1, 2, 3, 4}, {1, 2, 3, 3}));
  EXPECT_FALSE(fit_power_law({0, 2, 3, 4, 5}, x));
  EXPECT_FALSE(fit_power_law({1, 2, 2, 4, 5}, x));
  for (const double bad : {0.0, -1.0, double(INFINITY), double(NAN)})
    EXPECT_FALSE(fit_power_law(x, {1, 2, bad, 4, 5})) << bad;
}

}  // namespace
}  // namespace laboratory
