#include "experiments/laboratory/uncertain/intervals.hpp"

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "experiments/laboratory/table/linear_fit.hpp"
#include "experiments/laboratory/table/statistics.hpp"

namespace laboratory {

namespace {

constexpr double LOW = 0.05, HIGH = 0.95;
// probability that an entry is selected although no entry has an effect
constexpr double CHANCE = 0.05;
constexpr std::size_t MOST_CHOSEN = 8;

// The row of `table` with the same axis values as `row`; no value if there is none. Tries the row
// number `likely` first.
std::optional<std::size_t> find_row(const Table& table, const std::vector<Value>& row,
                                    std::size_t likely, std::size_t axes) {
  const auto is_it = [&](const std::vector<Value>& other) {
    return std::equal(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(axes), other.begin(),
                      is_same);
  };
  if (likely < table.rows.size() && is_it(table.rows[likely])) return likely;
  const auto found = std::ranges::find_if(table.rows, is_it);
  if (found == table.rows.end()) return {};
  return static_cast<std::size_t>(found - table.rows.begin());
}

// The results for a cell of the nominal table on all machines; empty if a machine has no result.
std::vector<double> gather(const Table& table, std::size_t row, std::size_t column,
                           const std::vector<Table>& machines) {
  std::vector<double> all;
  for (const auto& other : machines) {
    const auto there = find_row(other, table.rows[row], row, table.axes);
    const auto same = other.find(table.columns[column]);
    const auto number = there && same ? as_number(other.rows[*there][*same]) : std::nullopt;
    if (!number) return {};
    all.push_back(*number);
  }
  return all;
}

// A linear regression of the results on the quantiles of some entries.
struct Plane {
  std::vector<double> slopes, errors;  // slope for each entry, and its standard error
  std::vector<double> left;            // residual of each result
};

Plane fit_plane(const std::vector<double>& results,
                const std::vector<std::vector<double>>& quantiles,
                const std::vector<std::size_t>& chosen) {
  std::vector<std::vector<double>> terms{std::vector<double>(results.size(), 1)};
  for (const std::size_t entry : chosen) terms.push_back(quantiles[entry]);
  const auto fit = fit_linear(std::move(terms), results);
  Plane plane;
  for (std::size_t term = 1; term < fit.factors.size(); ++term) {
    plane.slopes.push_back(fit.factors[term]);
    plane.errors.push_back(std::sqrt(fit.variance(term)));
  }
  // Treats residuals that are only rounding errors as zero.
  const double size = *std::ranges::max_element(results, {}, [](double r) { return std::abs(r); });
  for (const double rest : fit.residuals)
    plane.left.push_back(std::abs(rest) > 1e-12 * std::abs(size) ? rest : 0);
  return plane;
}

}  // namespace

std::vector<Interval> find_intervals(const Table& table, const std::vector<Table>& machines) {
  std::vector<Interval> intervals;
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    for (std::size_t column = table.axes; column < table.columns.size(); ++column) {
      const auto value = as_number(table.rows[row][column]);
      auto all = value ? gather(table, row, column, machines) : std::vector<double>();
      if (all.empty()) continue;
      auto sorted = all;
      std::ranges::sort(sorted);
      if (sorted.front() == sorted.back()) continue;
      // Estimates the value below which the result on one more machine would lie with the
      // probability `share`: the sample with the rank share * (n + 1), counted from 1 and limited
      // to the existing ranks.
      const auto at = [&](double share) {
        const auto n = static_cast<double>(sorted.size());
        const double place = std::clamp((share * (n + 1) - 1) / (n - 1), 0.0, 1.0);
        return find_quantile(sorted, place);
      };
      intervals.push_back({row, column, *value, at(LOW), at(0.5), at(HIGH), std::move(all)});
    }
  return intervals;
}

std::vector<Influence> find_influences(const std::vector<double>& results,
                                       const std::vector<std::string>& entries,
                                       const std::vector<std::vector<double>>& quantiles) {
  const std::size_t n = results.size();
  base::require(n >= 3, "uncertain.machines", "found {}, expected at least 3 for influences", n);
  const double least =
      -normal_quantile(CHANCE / 2 / static_cast<double>(std::max<std::size_t>(1, entries.size())));
  std::vector<Influence> influences;
  std::vector<std::size_t> chosen;
  Plane plane = fit_plane(results, quantiles, chosen);
  while (chosen.size() < std::min(MOST_CHOSEN, (n - 1) / 2)) {
    std::pair<double, std::size_t> best{0, 0};
    for (std::size_t i = 0; i < entries.size(); ++i)
      if (std::ranges::find(chosen, i) == chosen.end())
        if (const double r = correlate_ranks(quantiles[i], plane.left);
            std::abs(r) > std::abs(best.first))
          best = {r, i};
    const double freedom = static_cast<double>(n - chosen.size() - 1);
    if (std::abs(best.first) * std::sqrt(freedom) < least) break;
    chosen.push_back(best.second);
    influences.push_back({entries[best.second], 0, 0, best.first});
    plane = fit_plane(results, quantiles, chosen);
  }
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    influences[i].swing = plane.slopes[i] * (HIGH - LOW);
    influences[i].error = plane.errors[i] * (HIGH - LOW);
  }
  std::ranges::stable_sort(influences, std::greater(),
                           [](const Influence& influence) { return std::abs(influence.swing); });
  return influences;
}

Table start_table(const Table& table, std::initializer_list<const char*> columns) {
  const auto axes = static_cast<std::ptrdiff_t>(table.axes);
  Table made{.columns = {table.columns.begin(), table.columns.begin() + axes},
             .axes = table.axes,
             .rows = {}};
  made.columns.insert(made.columns.end(), columns.begin(), columns.end());
  return made;
}

std::vector<Value> take_axes(const Table& table, std::size_t row) {
  const auto& cells = table.rows[row];
  return {cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(table.axes)};
}

Table make_intervals_table(const Table& table, const std::vector<Interval>& intervals) {
  Table made = start_table(table, {"column", "value", "p5", "p50", "p95"});
  for (const auto& interval : intervals) {
    auto cells = take_axes(table, interval.row);
    cells.emplace_back(table.columns[interval.column]);
    for (const double number : {interval.value, interval.low, interval.median, interval.high})
      cells.emplace_back(number);
    made.rows.push_back(std::move(cells));
  }
  return made;
}

}  // namespace laboratory
