#include "experiments/laboratory/judge/check_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "experiments/laboratory/points/results.hpp"

namespace laboratory {

namespace {

constexpr double NO_VALUE = std::numeric_limits<double>::quiet_NaN();

// What is no number is worse than anything.
double size_of(double error) { return std::isnan(error) ? INFINITY : std::abs(error); }

CheckedPoint compare(const Check& check, std::size_t row, double simulated, double expected) {
  double error = simulated - expected;
  if (!check.is_absolute() && error != 0) error /= std::abs(expected);
  if (!std::isfinite(simulated) || !std::isfinite(expected)) error = NO_VALUE;
  const auto limit = check.is_absolute() ? check.within_abs : check.within;
  return {row, simulated, expected, error, size_of(error) <= limit.value_or(1e300)};
}

// What is checked at a point; none for an empty cell, such as the speed-up where no row has one
// worker.
std::optional<double> find_simulated(const CheckPlan::Comparison& c, const Rows& rows,
                                     std::size_t row) {
  if (c.of) return rows.eval(*c.of, row);
  const Table& table = rows.table();
  return as_number(table.rows[row][*table.find(c.check.of)]);
}

// A point, where both sides are there.
void add_point(CheckResult& result, const CheckPlan::Comparison& c, const Rows& rows,
               std::size_t row, std::optional<double> expected,
               std::vector<std::size_t>& left_out) {
  const auto simulated = find_simulated(c, rows, row);
  if (!simulated || !expected) return left_out.push_back(row);
  auto point = compare(c.check, row, *simulated, *expected);
  point.is_calibrated = c.calibrated && rows.eval(*c.calibrated, row).value_or(0) != 0;
  result.points.push_back(point);
}

// Each row of the reference with the points that it is for, of those in question.
void compare_reference(CheckResult& result, const CheckPlan::Comparison& c, const Rows& rows,
                       const std::vector<std::size_t>& candidates,
                       std::vector<std::size_t>& left_out) {
  const Check& check = result.check;
  const Table& reference = *c.reference;
  const auto column = *reference.find(check.column);
  const auto matches = match_rows(reference, rows.table(), check.keys);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const auto expected = as_number(reference.rows[i][column]);
    if (!expected) continue;
    for (const auto row : matches[i])
      if (std::ranges::binary_search(candidates, row))
        add_point(result, c, rows, row, expected, left_out);
  }
  if (auto note = note_missing(reference, check.reference, check.column, check.keys, matches))
    result.notes.push_back(*note);
}

// Of the points that nothing was calibrated on.
std::optional<Predicted> judge_predicted(const std::vector<CheckedPoint>& points) {
  Predicted predicted;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].is_calibrated) continue;
    if (predicted.points++ == 0 ||
        size_of(points[i].error) > size_of(points[predicted.worst].error))
      predicted.worst = i;
    predicted.mean += size_of(points[i].error);
  }
  if (predicted.points == 0) return std::nullopt;
  predicted.mean /= static_cast<double>(predicted.points);
  return predicted;
}

void judge(CheckResult& result) {
  auto& points = result.points;
  if (points.empty()) return;
  const auto worse = [](const CheckedPoint& a, const CheckedPoint& b) {
    return std::pair(!a.holds, size_of(a.error)) < std::pair(!b.holds, size_of(b.error));
  };
  result.worst = static_cast<std::size_t>(std::ranges::max_element(points, worse) - points.begin());
  for (const auto& p : points) result.mean += size_of(p.error) / static_cast<double>(points.size());
  const bool holds = std::ranges::all_of(points, &CheckedPoint::holds) &&
                     result.mean <= result.check.within_mean.value_or(1e300);
  result.verdict = holds ? Verdict::holds : Verdict::fails;
}

// No point came to its end.
std::vector<CheckResult> find_nothing(const CheckPlan& plan) {
  std::vector<CheckResult> results;
  for (const auto& comparison : plan.comparisons) {
    results.emplace_back().check = comparison.check;
    results.back().verdict = Verdict::unmatched;
  }
  return results;
}

CheckResult eval_check(const CheckPlan::Comparison& c, const Rows& rows) {
  CheckResult result;
  result.check = c.check;
  result.verdict = Verdict::unmatched;
  const auto candidates = choose_rows(rows, c.where);
  std::vector<std::size_t> left_out;
  if (c.reference) compare_reference(result, c, rows, candidates, left_out);
  if (c.formula)
    for (const auto row : candidates)
      add_point(result, c, rows, row, rows.eval(*c.formula, row), left_out);
  if (const auto note = note_left_out(rows.table(), left_out)) result.notes.push_back(*note);
  judge(result);
  if (c.calibrated) result.predicted = judge_predicted(result.points);
  return result;
}

}  // namespace

std::vector<CheckResult> eval_checks(const CheckPlan& plan, const ExperimentFile& file,
                                     const Table& table) {
  if (plan.comparisons.empty()) return {};
  base::check_equal("points of the results", table.count_points(), file.points.size());
  const auto complete = [&](const auto& row) { return is_complete_row(table, row); };
  const auto first =
      static_cast<std::size_t>(std::ranges::find_if(table.rows, complete) - table.rows.begin());
  if (first == table.rows.size()) return find_nothing(plan);
  check_names(plan, file, table.point_of(first), table, table.rows[first]);
  const Rows rows = make_rows(plan, file, table);
  std::vector<CheckResult> results;
  for (const auto& comparison : plan.comparisons) results.push_back(eval_check(comparison, rows));
  return results;
}

}  // namespace laboratory
