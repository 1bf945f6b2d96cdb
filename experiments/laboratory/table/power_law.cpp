#include "experiments/laboratory/table/power_law.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/errors.hpp"
#include "experiments/laboratory/table/linear_fit.hpp"

namespace laboratory {
namespace {

// least number of points; a line with a bend would fit almost any four points
constexpr std::size_t FEWEST = 5;
constexpr double LEAST_CHANGE = 0.2, MOST_LEFT = 0.25;

struct Line {
  double before, after, squares;
};

// The logarithms of the numbers; empty if a number is not finite and positive.
std::vector<double> logs_of(const std::vector<double>& values) {
  std::vector<double> logs;
  for (const double value : values) {
    if (!std::isfinite(value) || value <= 0) return {};
    logs.push_back(std::log(value));
  }
  return logs;
}

Line fit_straight(const std::vector<double>& t, const std::vector<double>& v) {
  const auto fit = fit_linear({std::vector<double>(t.size(), 1), t}, v);
  return {fit.factors[1], fit.factors[1], fit.squares};
}

// Fits v = a + b t + c max(0, t - at), a line that bends at t = at.
Line fit_broken(const std::vector<double>& t, const std::vector<double>& v, double at) {
  std::vector<double> beyond;
  for (const double x : t) beyond.push_back(std::max(0.0, x - at));
  const auto fit = fit_linear({std::vector<double>(t.size(), 1), t, beyond}, v);
  return {fit.factors[1], fit.factors[1] + fit.factors[2], fit.squares};
}

}  // namespace

std::optional<PowerLaw> fit_power_law(const std::vector<double>& x, const std::vector<double>& y) {
  base::check_equal("points of a curve", y.size(), x.size());
  const auto t = logs_of(x), v = logs_of(y);
  const bool ascends = std::ranges::adjacent_find(t, std::greater_equal{}) == t.end();
  if (t.size() < FEWEST || v.size() < FEWEST || !ascends) return std::nullopt;
  const Line straight = fit_straight(t, v);
  PowerLaw growth{straight.before, straight.after};
  // A straight line whose residuals are only rounding errors needs no bend.
  double least = std::max(MOST_LEFT * straight.squares, 1e-18 * static_cast<double>(t.size()));
  if (straight.squares <= least) return growth;
  for (std::size_t i = 1; i + 1 < t.size(); ++i) {
    const Line broken = fit_broken(t, v, t[i]);
    if (broken.squares > least || std::abs(broken.after - broken.before) < LEAST_CHANGE) continue;
    least = broken.squares;
    growth = {broken.before, broken.after, x[i]};
  }
  return growth;
}

}  // namespace laboratory
