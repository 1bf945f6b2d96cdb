// Linear least squares: the conditions that the solution must fulfil, and known variances.
#include "experiments/laboratory/table/linear_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace laboratory {
namespace {

using Vector = std::vector<double>;

Vector draw_values(std::mt19937_64& random, std::size_t count) {
  Vector values(count);
  for (double& value : values) value = static_cast<double>(random() % 2000) / 1000 - 1;
  return values;
}

// The residuals are the values minus the fitted terms. They are orthogonal to each term.
TEST(LinearFit, ResidualsAreOrthogonalToTheTerms) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const std::size_t count = 1 + random() % 5, points = count + 1 + random() % 30;
    std::vector<Vector> terms;
    for (std::size_t k = 0; k < count; ++k) terms.push_back(draw_values(random, points));
    const Vector values = draw_values(random, points);
    const LinearFit fit = fit_linear(terms, values);
    double squares = 0;
    for (std::size_t i = 0; i < points; ++i) {
      double left = values[i];
      for (std::size_t k = 0; k < count; ++k) left -= fit.factors[k] * terms[k][i];
      EXPECT_NEAR(fit.residuals[i], left, 1e-9);
      squares += left * left;
    }
    EXPECT_NEAR(fit.squares, squares, 1e-9);
    for (const auto& term : terms) EXPECT_NEAR(dot(term, fit.residuals), 0, 1e-9);
  }
}

// For a line a + b x, the variance of b is the variance of one value, divided by the sum of
// (x - mean)^2.
TEST(LinearFit, VariancesOfALineAreTheTextbooks) {
  std::mt19937_64 random(2611);
  for (int trial = 0; trial < 50; ++trial) {
    const std::size_t points = 3 + random() % 30;
    const Vector x = draw_values(random, points), y = draw_values(random, points);
    const LinearFit fit = fit_linear({Vector(points, 1), x}, y);
    const auto n = static_cast<double>(points);
    const double mean = dot(x, Vector(points, 1)) / n;
    const double spread = dot(x, x) - n * mean * mean;
    if (spread < 1e-3) continue;
    const double variance = fit.squares / (n - 2);
    EXPECT_NEAR(fit.variance(1), variance / spread, 1e-9 * variance / spread);
    const double of_a = variance * (1 / n + mean * mean / spread);
    EXPECT_NEAR(fit.variance(0), of_a, 1e-9 * of_a);
  }
}

// After orthogonalisation, rounding leaves a small rest of the dependent term. It must not be
// fitted.
TEST(LinearFit, ATermThatDependsOnThoseBeforeItGetsZero) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const Vector first = draw_values(random, 12), second = draw_values(random, 12);
    Vector mixed, values;
    for (std::size_t i = 0; i < first.size(); ++i) {
      mixed.push_back(0.1 * first[i] + 0.3 * second[i]);
      values.push_back(first[i] + 2 * second[i]);
    }
    const LinearFit fit = fit_linear({first, second, mixed}, values);
    EXPECT_NEAR(fit.factors[0], 1, 1e-9);
    EXPECT_NEAR(fit.factors[1], 2, 1e-9);
    EXPECT_EQ(fit.factors[2], 0);
  }
}

}  // namespace
}  // namespace laboratory
