#include "experiments/laboratory/table/least_squares.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "experiments/laboratory/table/statistics.hpp"

namespace laboratory {
namespace {

// values of x, at which the logarithm of y = a + x / b is fitted
const std::vector<double> X = {1, 2, 4, 8, 16, 32, 64, 128, 256, 512};

Step steps(const std::vector<double>& all) {
  return [all](std::size_t parameter, double) { return all.at(parameter); };
}

Residuals line_residuals(const std::vector<double>& y, double grain = 0) {
  return [y, grain](const std::vector<double>& p) {
    std::vector<double> residuals;
    for (std::size_t i = 0; i < X.size(); ++i) {
      const double a = grain > 0 ? grain * std::round(p[0] / grain) : p[0];
      residuals.push_back(std::log((a + X[i] / p[1]) / y[i]));
    }
    return residuals;
  };
}

// 19 of 20 intervals contain the true value of the parameter.
TEST(LeastSquares, IntervalsHoldTheirNumber) {
  constexpr int TRIALS = 2000;
  std::mt19937_64 random(20261125);
  std::normal_distribution<double> noise(0, 0.05);
  int inside[2] = {};
  for (int trial = 0; trial < TRIALS; ++trial) {
    std::vector<double> y;
    for (const double x : X) y.push_back((20 + x / 1.7) * std::exp(noise(random)));
    const auto fit = fit_least_squares(line_residuals(y), {10, 1}, steps({0.01, 0.01}));
    const double t = student_t(0.975, double(X.size()) - 2);
    for (int p = 0; p < 2; ++p)
      inside[p] += std::abs(fit.parameters[p] - (p == 0 ? 20 : 1.7)) <= t * fit.errors[p];
  }
  for (const int count : inside) EXPECT_NEAR(count / double(TRIALS), 0.95, 0.015);
}

// A model that rounds its results is a step function. Its slope is found by finite differences that
// are wider than one of its steps.
TEST(LeastSquares, StepsAreWiderThanARoundingModels) {
  std::vector<double> y;
  for (const double x : X) y.push_back(20 + x / 1.7);
  const auto fit = fit_least_squares(line_residuals(y, 0.5), {3, 1}, steps({2.5, 0.1}));
  EXPECT_NEAR(fit.parameters[0], 20, 0.5);
  EXPECT_NEAR(fit.parameters[1], 1.7, 0.02);
}

TEST(LeastSquares, SaysWhatIsUndetermined) {
  const auto which = [](const Residuals& residuals) {
    try {
      fit_least_squares(residuals, {1, 1}, steps({0.1, 0.1}));
    } catch (const Undetermined& error) {
      return error.parameters;
    }
    return std::vector<std::size_t>{9};
  };
  using V = std::vector<double>;
  using Which = std::vector<std::size_t>;
  EXPECT_EQ(which([](const V& p) { return V{p[0], 2 * p[0], 3}; }), Which{1});
  EXPECT_EQ(which([](const V& p) {
              return V{p[0] + p[1], 2 * p[0] + 2 * p[1], 3};
            }),
            (Which{0, 1}));
  EXPECT_EQ(which([](const V& p) { return V{p[0] - 2, p[1] - 3, p[0] + p[1] - 4}; }), Which{9});
}

TEST(LeastSquares, WhatIsMetAtTheStartIsTheAnswer) {
  std::vector<double> y;
  for (const double x : X) y.push_back(20 + x / 1.7);
  const auto fit = fit_least_squares(line_residuals(y), {20, 1.7}, steps({0.01, 0.01}));
  EXPECT_EQ(fit.parameters, (std::vector<double>{20, 1.7}));
  EXPECT_EQ(fit.squares, 0);
}

TEST(LeastSquares, NeedsMoreResidualsThanParametersAndPassesOnWhatIsThrown) {
  const auto as_many = [](const std::vector<double>& p) { return p; };
  EXPECT_THROW(fit_least_squares(as_many, {1, 1}, steps({0.1, 0.1})), std::invalid_argument);
  int calls = 0;
  const auto fails = [&](const std::vector<double>& p) {
    if (++calls > 3) throw std::domain_error("no");
    return std::vector<double>{p[0], 1, 2};
  };
  EXPECT_THROW(fit_least_squares(fails, {1}, steps({0.1})), std::domain_error);
}

}  // namespace
}  // namespace laboratory
