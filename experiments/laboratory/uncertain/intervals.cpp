#include "experiments/laboratory/uncertain/intervals.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_multifit.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/errors.hpp"

namespace laboratory {

namespace {

constexpr double LOW = 0.05, HIGH = 0.95;
constexpr double CHANCE = 0.05;  // probability of selecting an entry if none has an effect
constexpr std::size_t MOST_CHOSEN = 8;

// The row of another table with the same axes; none if it is missing.
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

// The results of a cell on all machines; empty if a machine lacks it.
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
  std::vector<double> slopes, errors;  // slope of each entry, and its standard error
  std::vector<double> left;            // residual of each result
};

Plane fit_plane(const std::vector<double>& results,
                const std::vector<std::vector<double>>& quantiles,
                const std::vector<std::size_t>& chosen) {
  const std::size_t n = results.size(), terms = chosen.size() + 1;
  const auto row = [&](std::size_t machine, std::size_t term) {
    return term == 0 ? 1 : quantiles[chosen[term - 1]][machine];
  };
  const auto free = [](auto* what) {
    if constexpr (std::is_same_v<decltype(what), gsl_matrix*>)
      gsl_matrix_free(what);
    else if constexpr (std::is_same_v<decltype(what), gsl_vector*>)
      gsl_vector_free(what);
    else
      gsl_multifit_linear_free(what);
  };
  const auto own = [&](auto* what) {
    return std::unique_ptr<std::remove_pointer_t<decltype(what)>, decltype(free)>(what, free);
  };
  const auto x = own(gsl_matrix_alloc(n, terms)), covariances = own(gsl_matrix_alloc(terms, terms));
  const auto y = own(gsl_vector_alloc(n)), slopes = own(gsl_vector_alloc(terms));
  const auto left = own(gsl_vector_alloc(n));
  const auto work = own(gsl_multifit_linear_alloc(n, terms));
  for (std::size_t machine = 0; machine < n; ++machine) {
    gsl_vector_set(y.get(), machine, results[machine]);
    for (std::size_t term = 0; term < terms; ++term)
      gsl_matrix_set(x.get(), machine, term, row(machine, term));
  }
  double squares = 0;
  gsl_multifit_linear(x.get(), y.get(), slopes.get(), covariances.get(), &squares, work.get());
  gsl_multifit_linear_residuals(x.get(), y.get(), slopes.get(), left.get());
  Plane plane;
  for (std::size_t term = 1; term < terms; ++term) {
    plane.slopes.push_back(gsl_vector_get(slopes.get(), term));
    plane.errors.push_back(std::sqrt(gsl_matrix_get(covariances.get(), term, term)));
  }
  // Residuals that are only rounding errors count as zero.
  const double size = *std::ranges::max_element(results, {}, [](double r) { return std::abs(r); });
  for (std::size_t machine = 0; machine < n; ++machine) {
    const double rest = gsl_vector_get(left.get(), machine);
    plane.left.push_back(std::abs(rest) > 1e-12 * std::abs(size) ? rest : 0);
  }
  return plane;
}

// Spearman's rank correlation; NaN if either sample is constant.
double correlate_ranks(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> work(2 * a.size());
  return gsl_stats_spearman(a.data(), 1, b.data(), 1, a.size(), work.data());
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
      // Estimates a quantile such that a further machine lies below it with that probability. Its
      // rank is share * (n + 1), counted from 1 and clamped to the samples.
      const auto at = [&](double share) {
        const auto n = static_cast<double>(sorted.size());
        const double place = std::clamp((share * (n + 1) - 1) / (n - 1), 0.0, 1.0);
        return gsl_stats_quantile_from_sorted_data(sorted.data(), 1, sorted.size(), place);
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
  const double least = gsl_cdf_ugaussian_Qinv(
      CHANCE / 2 / static_cast<double>(std::max<std::size_t>(1, entries.size())));
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
