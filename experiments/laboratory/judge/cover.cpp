#include "experiments/laboratory/judge/cover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/laboratory/table/statistics.hpp"

namespace laboratory {
namespace {

using Range = std::pair<double, double>;

bool contains(const Range& range, double value) {
  return range.first <= value && value <= range.second;
}

// A point that was not used for calibration, with the interval that contains 90 % of its results on
// randomly drawn machines.
struct Case {
  const CheckedPoint* point;
  Range machines;
};

std::vector<Case> find_cases(const CheckResult& result, const Table& table,
                             const ConfidenceTables& confidence) {
  std::vector<Case> cases;
  const bool is_column = table.find(result.check.of).has_value();
  for (const auto& point : result.points) {
    if (point.kind == Kind::calibrated) continue;
    if (const auto range = find_interval(confidence, table, point.row, result.check.of))
      cases.push_back({&point, *range});
    else if (is_column)  // a column without an interval has the same value on all drawn machines
      cases.push_back({&point, {point.simulated, point.simulated}});
  }
  return cases;
}

// Makes the interval around the nominal result, shifted by the mean of the model's own error. The
// uncertain parameters and the model's own error are independent, so the half width is the square
// root of the sum of the two squared half widths.
Range make_range_with(const OwnError& error, const Case& it) {
  const double simulated = it.point->simulated;
  const double middle = simulated * (1 + error.mean);
  const double half =
      std::hypot((it.machines.second - it.machines.first) / 2, simulated * error.half_width);
  return {middle - half, middle + half};
}

std::optional<CheckResult::WithOwnError> cover_with_own_error(const std::vector<Case>& cases) {
  std::vector<double> errors, half_widths, means;
  for (const auto& it : cases)
    errors.push_back((it.point->expected - it.point->simulated) / it.point->simulated);
  if (!std::ranges::all_of(errors, [](double error) { return std::isfinite(error); })) return {};
  CheckResult::WithOwnError covered;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    auto others = errors;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const auto own = find_own_error(others);
    if (!own) return {};
    const Range range = make_range_with(*own, cases[i]);
    means.push_back(own->mean);
    covered.inside += contains(range, cases[i].point->expected);
    half_widths.push_back((range.second - range.first) / 2 / std::abs(cases[i].point->simulated));
  }
  covered.half_width = find_median(half_widths);
  covered.mean = find_median(means);
  return covered;
}

}  // namespace

std::optional<OwnError> find_own_error(const std::vector<double>& errors) {
  if (errors.size() < 3) return std::nullopt;
  const auto count = static_cast<double>(errors.size());
  return OwnError{find_mean(errors),
                  student_t(0.95, count - 1) * find_deviation(errors) * std::sqrt(1 + 1 / count)};
}

void check_cover(std::vector<CheckResult>& results, const Table& table,
                 const ConfidenceTables& confidence) {
  for (auto& result : results) {
    if (result.check.has_bounds()) continue;
    const auto cases = find_cases(result, table, confidence);
    const auto& asked = result.check.covers;
    if (cases.empty()) {
      if (!asked || result.points.empty()) continue;
      result.notes.push_back(
          fmt::format("covers: no point of {} has an interval and is predicted", result.check.of));
      result.verdict = Verdict::fails;
      continue;
    }
    CheckResult::Covered covered{.points = cases.size()};
    for (const auto& it : cases) covered.inside += contains(it.machines, it.point->expected);
    if (!result.check.is_absolute()) covered.with_own_error = cover_with_own_error(cases);
    result.covered = covered;
    const double share = static_cast<double>(covered.inside) / static_cast<double>(covered.points);
    if (asked && share < *asked) result.verdict = Verdict::fails;
  }
}

}  // namespace laboratory
