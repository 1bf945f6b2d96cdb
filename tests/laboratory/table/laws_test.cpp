// Laws of speed-up, applied to data with known serial fractions.
#include "experiments/laboratory/table/laws.hpp"

#include <gtest/gtest.h>
#include <algorithm>

#include <cmath>
#include <random>

namespace laboratory {
namespace {

using Numbers = std::vector<double>;

const Numbers WORKERS = {1, 2, 4, 8, 16, 32, 64, 128, 256};

template <class Law>
Numbers map(const Numbers& n, const Law& law) {
  Numbers values;
  for (const double x : n) values.push_back(law(x));
  return values;
}

double memory_growth(double n) { return std::pow(n, 1.3); }

TEST(ExperimentsLaws, AmdahlAndGustafsonAreSunAndNisSpecialCases) {
  for (const double s : {0.0, 0.01, 0.3, 1.0})
    for (const double n : WORKERS) {
      EXPECT_DOUBLE_EQ(sun_ni_speedup(s, n, 1), amdahl_speedup(s, n));
      EXPECT_NEAR(sun_ni_speedup(s, n, n), gustafson_speedup(s, n), 1e-12 * n);
      EXPECT_GE(sun_ni_speedup(s, n, memory_growth(n)), gustafson_speedup(s, n) - 1e-12 * n);
    }
}

TEST(ExperimentsLaws, OnePointSolvesForTheSerialFraction) {
  EXPECT_NEAR(*karp_flatt(8, amdahl_speedup(0.07, 8)), 0.07, 1e-15);
  EXPECT_NEAR(*serial_gustafson(8, gustafson_speedup(0.07, 8)), 0.07, 1e-15);
  EXPECT_NEAR(*serial_gustafson(2, 1.96), 0.04, 1e-12);  // a value of the thesis, table 4.3
  EXPECT_EQ(karp_flatt(4, 4), 0);
  EXPECT_LT(*karp_flatt(4, 5), 0) << "faster than n processors can be";
  for (const auto& [n, s] : {std::pair(1.0, 1.0), {4.0, NAN}, {4.0, 0.0}, {NAN, 2.0}, {0.5, 1.0}}) {
    EXPECT_FALSE(karp_flatt(n, s)) << n << " " << s;
    EXPECT_FALSE(serial_gustafson(n, s)) << n << " " << s;
  }
}

TEST(ExperimentsLaws, FitsFindWhatMadeTheData) {
  for (const double s : {0.0, 0.001, 0.05, 0.5, 1.0}) {
    const auto amdahl =
        fit_amdahl(WORKERS, map(WORKERS, [&](double n) { return amdahl_speedup(s, n); }));
    const auto gustafson =
        fit_gustafson(WORKERS, map(WORKERS, [&](double n) { return gustafson_speedup(s, n); }));
    const auto growth = map(WORKERS, memory_growth);
    const auto sun_ni = fit_sun_ni(
        WORKERS, map(WORKERS, [&](double n) { return sun_ni_speedup(s, n, memory_growth(n)); }),
        growth);
    for (const auto& fit : {amdahl, gustafson, sun_ni}) {
      ASSERT_TRUE(fit) << s;
      EXPECT_NEAR(fit->parameters.at(0).value, s, 1e-8) << fit->law;
      EXPECT_NEAR(fit->parameters[0].high, s, 1e-7) << fit->law;
      EXPECT_NEAR(fit->rms, 0, 1e-8) << fit->law;
      EXPECT_EQ(fit->points, 8u) << "one processor says nothing";
    }
  }
  const auto log = fit_log({10, 100, 1000}, {1, 3, 5});
  ASSERT_TRUE(log);
  EXPECT_NEAR(log->parameters.at(0).value, -1, 1e-12);
  EXPECT_NEAR(log->parameters.at(1).value, 2, 1e-12);
}

// If the minimised quantity has noise of constant variance, 95 % of the intervals contain the true
// value. For 1000 repeats, the standard deviation of the counted share is 0.7 %.
TEST(ExperimentsLaws, NineteenOfTwentyIntervalsHoldTheTruth) {
  constexpr int REPEATS = 1000;
  constexpr std::uint32_t SEED = 20241;
  constexpr double SERIAL = 0.08;
  std::mt19937 random(SEED);
  std::normal_distribution<double> noise(0, 0.004);
  int amdahl = 0, gustafson = 0, sun_ni = 0, log = 0;
  const auto holds = [](const std::optional<Fit>& fit, std::size_t i, double truth) {
    return fit && fit->parameters[i].low <= truth && truth <= fit->parameters[i].high;
  };
  const auto growth = map(WORKERS, memory_growth);
  for (int repeat = 0; repeat < REPEATS; ++repeat) {
    amdahl += holds(
        fit_amdahl(WORKERS, map(WORKERS,
                                [&](double n) {
                                  return 1 / (1 / amdahl_speedup(SERIAL, n) + noise(random) / 4);
                                })),
        0, SERIAL);
    gustafson +=
        holds(fit_gustafson(WORKERS, map(WORKERS,
                                         [&](double n) {
                                           return gustafson_speedup(SERIAL, n) + n * noise(random);
                                         })),
              0, SERIAL);
    sun_ni += holds(fit_sun_ni(WORKERS,
                               map(WORKERS,
                                   [&](double n) {
                                     return sun_ni_speedup(SERIAL, n, memory_growth(n)) +
                                            n * noise(random);
                                   }),
                               growth),
                    0, SERIAL);
    log += holds(
        fit_log(WORKERS,
                map(WORKERS, [&](double n) { return 3 + 2 * std::log10(n) + noise(random); })),
        1, 2);
  }
  for (const int found : {amdahl, gustafson, sun_ni, log})
    EXPECT_NEAR(found, 950, 28) << "of 1000, seed " << SEED << ": " << amdahl << " " << gustafson
                                << " " << sun_ni << " " << log;
}

TEST(ExperimentsLaws, TooFewPointsAreNoFit) {
  EXPECT_FALSE(fit_amdahl({}, {}));
  EXPECT_FALSE(fit_amdahl({1, 1}, {1, 1}));
  EXPECT_FALSE(fit_amdahl({1, 2}, {1, 1.9}));
  EXPECT_FALSE(fit_gustafson({2, 4}, {1.9, NAN}));
  EXPECT_FALSE(fit_sun_ni({1, 2}, {1, 1.9}, {1, 2}));
  EXPECT_FALSE(fit_log({1, 2}, {1, 2}));
  EXPECT_FALSE(fit_log({2, 2, 2}, {1, 2, 3}));
}

TEST(ExperimentsLaws, TheIdealHasNoSerialPart) {
  for (const auto& fit : {fit_amdahl(WORKERS, WORKERS), fit_gustafson(WORKERS, WORKERS),
                          fit_sun_ni(WORKERS, WORKERS, map(WORKERS, memory_growth))}) {
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->parameters[0].value, 0, 1e-7) << fit->law;
    EXPECT_NEAR(fit->parameters[0].standard_error, 0, 1e-7) << fit->law;
  }
}

// The speed-up stays at 5 from five workers on. No serial fraction describes this.
TEST(ExperimentsLaws, ASaturatedSpeedupFitsNoLaw) {
  std::vector<double> n, speedup;
  for (const double workers : {1, 2, 4, 8, 16, 32, 64}) {
    n.push_back(workers);
    speedup.push_back(std::min(workers, 5.0));
  }
  for (const auto& fit : {fit_amdahl(n, speedup), fit_gustafson(n, speedup)}) {
    ASSERT_TRUE(fit && fit->misfit);
    EXPECT_GT(std::abs(fit->misfit->t), fit->misfit->limit);
    EXPECT_GT(fit->misfit->deviation, 0.05);
  }
}

// Speed-ups that follow a law, exactly or with an error of 1 %, are not reported as a misfit.
TEST(ExperimentsLaws, ALawThatMadeTheDataFits) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0, 0.01);
  std::vector<double> n, exact, noisy;
  for (const double workers : {1, 2, 4, 8, 16, 32, 64}) {
    n.push_back(workers);
    exact.push_back(amdahl_speedup(0.05, workers));
    noisy.push_back(exact.back() * std::exp(noise(random)));
  }
  EXPECT_FALSE(fit_amdahl(n, exact)->misfit);
  EXPECT_FALSE(fit_amdahl(n, noisy)->misfit);
}

}  // namespace
}  // namespace laboratory
