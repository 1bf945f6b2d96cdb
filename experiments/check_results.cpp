#include "experiments/check_results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "experiments/machine_model.hpp"
#include "experiments/results.hpp"
#include "simulator/machine/faults.hpp"

namespace experiments {

namespace {

constexpr double NO_VALUE = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t MOST_NAMED = 5;  // rows of a reference in one note

// What is no number is worse than anything.
double size_of(double error) { return std::isnan(error) ? INFINITY : std::abs(error); }

CheckedPoint compare(const Check& check, std::size_t row, double simulated, double expected) {
  double error = simulated - expected;
  if (!check.is_absolute() && error != 0) error /= std::abs(expected);
  if (!std::isfinite(simulated) || !std::isfinite(expected)) error = NO_VALUE;
  const auto limit = check.is_absolute() ? check.within_abs : check.within;
  return {row, simulated, expected, error, size_of(error) <= limit.value_or(1e300)};
}

bool equal(const Value& a, const Value& b) {
  const auto x = as_number(a), y = as_number(b);
  return x && y ? *x == *y : a == b;
}

std::string name_row(const Table& table, const std::vector<Value>& row,
                     const std::vector<std::string>& keys) {
  std::vector<std::string> parts;
  for (const auto& key : keys)
    parts.push_back(fmt::format("{} = {}", key, to_string(row[*table.find(key)])));
  return fmt::format("{}", fmt::join(parts, ", "));
}

// Each row of the reference with the points that it is for, of those in question.
void compare_reference(CheckResult& result, const Table& reference, const Table& table,
                       const std::vector<std::size_t>& candidates) {
  const Check& check = result.check;
  const auto column = *reference.find(check.column), of = *table.find(check.of);
  std::vector<std::string> missing;
  for (const auto& row : reference.rows) {
    const auto expected = as_number(row[column]);
    if (!expected) continue;
    const auto is_for = [&](const std::vector<Value>& point) {
      return std::ranges::all_of(check.keys, [&](const auto& key) {
        return equal(point[*table.find(key)], row[*reference.find(key)]);
      });
    };
    for (const std::size_t i : candidates)
      if (is_for(table.rows[i]))
        result.points.push_back(
            compare(check, i, as_number(table.rows[i][of]).value_or(NO_VALUE), *expected));
    if (std::ranges::none_of(table.rows, is_for))
      missing.push_back(name_row(reference, row, check.keys));
  }
  if (missing.empty()) return;
  const auto count = missing.size();
  missing.resize(std::min(count, MOST_NAMED));
  result.notes.push_back(fmt::format("{} row(s) of {} were not run: {}{}", count, check.reference,
                                     fmt::join(missing, "; "), count > MOST_NAMED ? "; ..." : ""));
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

bool is_true(const Check& check, double value) {
  if (std::isnan(value))
    throw machine::InvalidInput(
        fmt::format("check \"{}\": where: found nan at some point, expected a number", check.name));
  return value != 0;
}

// No point came to its end.
std::vector<CheckResult> find_nothing(const CheckPlan& plan) {
  std::vector<CheckResult> results;
  for (const auto& comparison : plan.comparisons) {
    results.push_back({comparison.check, {}, {}, 0, 0, {}});
    results.back().verdict = Verdict::unmatched;
  }
  return results;
}

}  // namespace

std::vector<CheckResult> eval_checks(const CheckPlan& plan, const ExperimentFile& file,
                                     const Table& table) {
  if (plan.comparisons.empty()) return {};
  machine::check_equal("rows of the results", table.rows.size(), file.points.size());
  const auto complete = [&](const auto& row) { return is_complete_row(table, row); };
  const auto first = std::ranges::find_if(table.rows, complete) - table.rows.begin();
  if (first == std::ssize(table.rows)) return find_nothing(plan);
  check_names(plan, file, static_cast<std::size_t>(first), table, table.rows[first]);
  std::map<std::string, machine::Model> models;
  std::vector<Variables> variables;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const auto& point = file.points[i];
    const auto key = model_key(point.experiment);
    if (!models.contains(key)) models.emplace(key, make_model(point.experiment));
    variables.push_back(make_variables(plan, point, models.at(key), table, table.rows[i]));
  }
  std::vector<CheckResult> results;
  for (const auto& [check, formula, where, reference] : plan.comparisons) {
    auto eval = [&](const machine::Formula& f, std::size_t i) {
      return f.eval(variables[i].get_all(f.variables(), f.place()));
    };
    CheckResult result{check, {}, {}, 0, 0, {}};
    result.verdict = Verdict::unmatched;
    std::vector<std::size_t> candidates;
    for (std::size_t i = 0; i < table.rows.size(); ++i)
      if (is_complete_row(table, table.rows[i]) && (!where || is_true(check, eval(*where, i))))
        candidates.push_back(i);
    const auto of = *table.find(check.of);
    if (reference) compare_reference(result, *reference, table, candidates);
    if (formula)
      for (const auto i : candidates)
        result.points.push_back(
            compare(check, i, as_number(table.rows[i][of]).value_or(NO_VALUE), eval(*formula, i)));
    judge(result);
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace experiments
