#include "experiments/laboratory/compare/ratios.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/laboratory/table/samples.hpp"
#include "experiments/laboratory/table/statistics.hpp"

namespace laboratory {
namespace {

using Numbers = std::vector<double>;
using Rows = std::vector<std::size_t>;

bool is_empty(const Table& table, std::size_t row, const std::string& column) {
  return table.rows[row][*table.find(column)] == Value();
}

// The numbers of a column in the given rows. Skips empty cells. No value if all cells are empty or
// a cell is a string.
std::optional<Numbers> find_numbers(const Table& table, const Rows& rows,
                                    const std::string& column) {
  Numbers numbers;
  const auto c = *table.find(column);
  for (const auto row : rows) {
    if (is_empty(table, row, column)) continue;
    const auto number = as_number(table.rows[row][c]);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers.empty() ? std::nullopt : std::optional(numbers);
}

// The logarithms of the numbers of a column; no value if a number is infinite or not positive.
std::optional<Numbers> find_logs(const Table& table, const Rows& rows, const std::string& column) {
  auto numbers = find_numbers(table, rows, column);
  if (!numbers) return std::nullopt;
  for (double& number : *numbers) {
    if (!std::isfinite(number) || number <= 0) return std::nullopt;
    number = std::log(number);
  }
  return numbers;
}

// The result of a run at a point. For several samples it is their geometric mean, or their
// arithmetic mean if one of them is not positive.
Value find_value(const MatchedRuns& matched, const MatchedRuns::Point& point, std::size_t run,
                 const std::string& column) {
  const Table& table = matched.runs[run].table;
  const auto& rows = point.rows[run];
  if (rows.size() == 1) return table.rows[rows[0]][*table.find(column)];
  if (const auto logs = find_logs(table, rows, column)) return std::exp(find_mean(*logs));
  if (const auto numbers = find_numbers(table, rows, column)) return find_mean(*numbers);
  return {};
}

// Rows of two runs, paired by equal seeds: both lists have the seeds in the same order. Omits seeds
// for which the column is empty in either run. No value if the runs have different seeds.
std::optional<std::pair<Rows, Rows>> pair_seeds(const Table& a, const Table& b, const Rows& rows_a,
                                                const Rows& rows_b, const std::string& seed,
                                                const std::string& column) {
  const auto seed_a = a.find(seed), seed_b = b.find(seed);
  if (!seed_a || !seed_b || rows_a.size() != rows_b.size()) return std::nullopt;
  std::map<std::string, std::size_t> row_of;
  for (const auto row : rows_b) row_of[to_string(b.rows[row][*seed_b])] = row;
  std::pair<Rows, Rows> paired;
  for (const auto row : rows_a) {
    const auto found = row_of.find(to_string(a.rows[row][*seed_a]));
    if (found == row_of.end()) return std::nullopt;
    if (is_empty(a, row, column) || is_empty(b, found->second, column)) continue;
    paired.first.push_back(row);
    paired.second.push_back(found->second);
  }
  return paired;
}

// True if two cells are equal, or are numbers that differ only by rounding.
bool is_near(const Value& a, const Value& b) {
  const auto x = as_number(a), y = as_number(b);
  if (!x || !y) return is_same(a, b);
  if (!std::isfinite(*x) || !std::isfinite(*y)) return is_same(a, b);
  return std::abs(*x - *y) <= 1e-12 * std::max(std::abs(*x), std::abs(*y));
}

std::string format_interval(const Ratio& ratio) {
  if (!ratio.interval) return "";
  return fmt::format("{:.4g} to {:.4g}", ratio.interval->first, ratio.interval->second);
}

}  // namespace

std::optional<Ratio> find_ratio(const MatchedRuns& matched, const MatchedRuns::Point& point,
                                std::size_t run, const std::string& column) {
  const Table &first = matched.runs[0].table, &other = matched.runs[run].table;
  const auto paired =
      pair_seeds(first, other, point.rows[0], point.rows[run], matched.seed, column);
  const auto a = find_logs(first, paired ? paired->first : point.rows[0], column);
  const auto b = find_logs(other, paired ? paired->second : point.rows[run], column);
  if (!a || !b) return std::nullopt;
  const double middle = find_mean(*b) - find_mean(*a);
  Ratio ratio{std::exp(middle)};
  const auto half = (paired ? find_paired_difference(*a, *b) : find_difference(*a, *b)).half_width;
  if (half) ratio.interval = {std::exp(middle - *half), std::exp(middle + *half)};
  return ratio;
}

std::optional<std::pair<double, double>> find_interval_of(const MatchedRuns& matched,
                                                          const MatchedRuns::Point& point,
                                                          std::size_t run,
                                                          const std::string& column) {
  const Table& table = matched.runs[run].table;
  const auto logs = find_logs(table, point.rows[run], column);
  const auto numbers = logs ? logs : find_numbers(table, point.rows[run], column);
  if (!numbers) return std::nullopt;
  const auto found = find_mean_interval(*numbers);
  if (!found.half_width) return std::nullopt;
  return logs ? std::pair(std::exp(found.low()), std::exp(found.high()))
              : std::pair(found.low(), found.high());
}

Spread find_spread(const MatchedRuns& matched, std::size_t run, const std::string& column) {
  Spread spread;
  Numbers logs;
  for (const auto& point : matched.points) {
    const bool is_equal =
        is_near(find_value(matched, point, 0, column), find_value(matched, point, run, column));
    const auto ratio = find_ratio(matched, point, run, column);
    if (!ratio) {
      if (is_equal) continue;
      if (spread.others++ == 0) spread.other = &point;
      continue;
    }
    const double value = is_equal ? 1 : ratio->value;
    if (spread.points == 0 || value < spread.least) {
      spread.least = value;
      spread.least_at = &point;
    }
    if (spread.points == 0 || value > spread.most) {
      spread.most = value;
      spread.most_at = &point;
    }
    ++spread.points;
    logs.push_back(std::log(value));
    if (!ratio->interval) continue;
    ++spread.intervals;
    spread.below += ratio->interval->second < 1;
    spread.above += ratio->interval->first > 1;
  }
  if (!logs.empty()) spread.mean = std::exp(find_mean(logs));
  return spread;
}

std::string tell_spread(const MatchedRuns& matched, std::size_t run, const std::string& column,
                        const Spread& spread) {
  constexpr double NEXT_TO_NOTHING = 1e-4;
  const auto& first = matched.runs[0].name;
  const auto& name = matched.runs[run].name;
  const auto at = [&](const MatchedRuns::Point& point) {
    return matched.axes.empty() ? std::string() : " at " + name_point(matched, point);
  };
  if (spread.is_same()) return fmt::format("{}: {} is the same as {}", column, name, first);
  std::string text = column + ": ";
  if (spread.points > 0 && 1 - spread.least < NEXT_TO_NOTHING &&
      spread.most - 1 < NEXT_TO_NOTHING) {
    text += fmt::format("{} is within 0.01 % of {}", name, first);
  } else if (spread.points > 0) {
    text += fmt::format("{} is {:.4g} times {}", name, spread.mean, first);
    if (spread.points > 1)
      text += fmt::format(" (geometric mean of {} points; {:.4g}{} to {:.4g}{})", spread.points,
                          spread.least, at(*spread.least_at), spread.most, at(*spread.most_at));
  }
  if (spread.intervals > 0)
    text += fmt::format("; the 95 % interval is below 1 at {} and above 1 at {} of {} points",
                        spread.below, spread.above, spread.intervals);
  if (spread.others > 0)
    text +=
        fmt::format("{}{} differs from {} at {} point(s) without a ratio: {} and {}{}",
                    spread.points > 0 ? "; " : "", name, first, spread.others,
                    to_string(find_value(matched, *spread.other, 0, column)),
                    to_string(find_value(matched, *spread.other, run, column)), at(*spread.other));
  return text;
}

std::vector<std::string> find_common_results(const std::vector<NamedTable>& runs) {
  std::vector<std::string> columns;
  for (const auto& column : runs[0].table.columns) {
    const bool everywhere = std::ranges::all_of(runs, [&](const NamedTable& run) {
      const auto c = run.table.find(column);
      return c && *c >= run.table.axes && is_numeric(run.table, *c);
    });
    if (everywhere) columns.push_back(column);
  }
  return columns;
}

Table compare_column(const MatchedRuns& matched, const std::string& column) {
  const auto& runs = matched.runs;
  std::vector<std::optional<Ratio>> ratios;  // ratios by point, then by run
  for (const auto& point : matched.points)
    for (std::size_t r = 1; r < runs.size(); ++r)
      ratios.push_back(find_ratio(matched, point, r, column));
  const bool has_intervals =
      std::ranges::any_of(ratios, [](const auto& ratio) { return ratio && ratio->interval; });

  Table table{.columns = matched.axes, .axes = matched.axes.size(), .rows = {}};
  for (const auto& run : runs) table.columns.push_back(fmt::format("{}: {}", run.name, column));
  for (std::size_t r = 1; r < runs.size(); ++r) {
    table.columns.push_back(fmt::format("{} / {}", runs[r].name, runs[0].name));
    if (has_intervals) table.columns.push_back(table.columns.back() + ", 95 %");
  }
  auto ratio = ratios.begin();
  for (const auto& point : matched.points) {
    auto& row = table.rows.emplace_back(point.at);
    for (std::size_t r = 0; r < runs.size(); ++r)
      row.push_back(find_value(matched, point, r, column));
    for (std::size_t r = 1; r < runs.size(); ++r, ++ratio) {
      auto& value = row.emplace_back();
      if (*ratio) value = (*ratio)->value;
      if (!has_intervals) continue;
      auto& interval = row.emplace_back();
      if (*ratio) interval = format_interval(**ratio);
    }
  }
  return table;
}

Table list_ratios(const MatchedRuns& matched, const std::vector<std::string>& columns) {
  Table table{.columns = {"result"}, .axes = 2 + matched.axes.size(), .rows = {}};
  table.columns.insert(table.columns.end(), matched.axes.begin(), matched.axes.end());
  for (const auto* column : {"run", "value", "first", "ratio", "low", "high"})
    table.columns.emplace_back(column);
  for (const auto& column : columns)
    for (const auto& point : matched.points)
      for (std::size_t r = 1; r < matched.runs.size(); ++r) {
        auto& row = table.rows.emplace_back();
        row.emplace_back(column);
        row.insert(row.end(), point.at.begin(), point.at.end());
        row.emplace_back(matched.runs[r].name);
        row.push_back(find_value(matched, point, r, column));
        row.push_back(find_value(matched, point, 0, column));
        const auto ratio = find_ratio(matched, point, r, column);
        row.resize(table.columns.size());
        const auto last = row.size() - 1;
        if (ratio) row[last - 2] = ratio->value;
        if (ratio && ratio->interval) {
          row[last - 1] = ratio->interval->first;
          row[last] = ratio->interval->second;
        }
      }
  return table;
}

Table stack_runs(const MatchedRuns& matched, const std::vector<std::string>& columns) {
  Table table{.columns = {"run"}, .axes = 1 + matched.axes.size(), .rows = {}};
  table.columns.insert(table.columns.end(), matched.axes.begin(), matched.axes.end());
  table.columns.insert(table.columns.end(), columns.begin(), columns.end());
  for (std::size_t r = 0; r < matched.runs.size(); ++r)
    for (const auto& point : matched.points) {
      auto& row = table.rows.emplace_back();
      row.emplace_back(matched.runs[r].name);
      row.insert(row.end(), point.at.begin(), point.at.end());
      for (const auto& column : columns) row.push_back(find_value(matched, point, r, column));
    }
  return table;
}

}  // namespace laboratory
