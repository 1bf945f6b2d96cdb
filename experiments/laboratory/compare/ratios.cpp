#include "experiments/laboratory/compare/ratios.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/errors.hpp"
#include "experiments/laboratory/table/axis_values.hpp"
#include "experiments/laboratory/table/statistics.hpp"

namespace laboratory {
namespace {

using Texts = std::vector<std::string>;

bool contains(const Texts& texts, const std::string& text) {
  return std::ranges::find(texts, text) != texts.end();
}

Texts axes_of(const Table& table) {
  return {table.columns.begin(), table.columns.begin() + static_cast<std::ptrdiff_t>(table.axes)};
}

std::size_t count_values(const Table& table, const std::string& axis) {
  return distinct(table, all_rows(table), *table.find(axis)).size();
}

bool is_axis(const Table& table, const std::string& name) {
  const auto column = table.find(name);
  return column && *column < table.axes;
}

// The axes by which points are told apart.
Texts choose_axes(const std::vector<NamedTable>& runs) {
  Texts chosen;
  for (const auto& run : runs)
    for (const auto& axis : axes_of(run.table)) {
      if (is_seed(axis) || contains(chosen, axis)) continue;
      bool varies = false;
      const NamedTable* without = nullptr;
      for (const auto& other : runs)
        if (is_axis(other.table, axis))
          varies = varies || count_values(other.table, axis) > 1;
        else
          without = &other;
      if (!varies) continue;
      if (without)
        throw base::BadInput(
            fmt::format("{}: found the axis {} with several values, which {} does "
                        "not have: expected runs over the same axes",
                        run.name, axis, without->name));
      chosen.push_back(axis);
    }
  return chosen;
}

// The cells of these axes as one text; numbers as numbers.
Texts key_of(const Table& table, std::size_t row, const Texts& axes) {
  Texts key;
  for (const auto& axis : axes) {
    const auto& cell = table.rows[row][*table.find(axis)];
    const auto number = as_number(cell);
    key.push_back(number ? to_string(to_cell(*number)) : to_string(cell));
  }
  return key;
}

using Groups = std::map<Texts, std::vector<std::size_t>>;

std::string name_point(const Texts& axes, const Texts& values) {
  Texts parts;
  for (std::size_t i = 0; i < axes.size(); ++i)
    parts.push_back(fmt::format("{} = {}", axes[i], values[i]));
  return join_texts(parts, ", ");
}

[[noreturn]] void throw_apart(const std::vector<NamedTable>& runs, const Texts& axes) {
  Texts values;
  for (const auto& axis : axes)
    for (const auto& run : runs) {
      Texts taken;
      for (const auto& value : distinct(run.table, all_rows(run.table), *run.table.find(axis)))
        taken.push_back(to_string(value));
      values.push_back(fmt::format("{} is {} in {}", axis, join_texts(taken, ", "), run.name));
    }
  throw base::BadInput(fmt::format("found no point that all runs have ({}), expected some",
                                   join_texts(values, "; ")));
}

std::optional<double> number_at(const Table& table, std::size_t row, const std::string& column) {
  const auto c = table.find(column);
  return c ? as_number(table.rows[row][*c]) : std::nullopt;
}

std::vector<double> numbers_at(const NamedTable& run, const std::vector<std::size_t>& rows,
                               const std::string& column) {
  std::vector<double> numbers;
  for (const auto row : rows)
    if (const auto number = number_at(run.table, row, column)) numbers.push_back(*number);
  return numbers;
}

std::vector<double> logs_of(const std::vector<double>& numbers) {
  std::vector<double> logs;
  for (const double number : numbers) logs.push_back(std::log(number));
  return logs;
}

struct Estimate {
  double mean, half_width;
};

Estimate estimate(double mean, double standard_error, double degrees) {
  return {mean, standard_error == 0 ? 0 : student_t(0.975, degrees) * standard_error};
}

Estimate estimate_pairs(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < a.size(); ++i) differences.push_back(b[i] - a[i]);
  const auto n = static_cast<double>(a.size());
  return estimate(find_mean(differences), find_deviation(differences) / std::sqrt(n), n - 1);
}

Estimate estimate_apart(const std::vector<double>& a, const std::vector<double>& b) {
  const auto squared = [](const std::vector<double>& x) {
    return find_variance(x) / static_cast<double>(x.size());
  };
  const double va = squared(a), vb = squared(b);
  const double degrees =
      (va + vb) * (va + vb) /
      (va * va / static_cast<double>(a.size() - 1) + vb * vb / static_cast<double>(b.size() - 1));
  return estimate(find_mean(b) - find_mean(a), std::sqrt(va + vb), degrees);
}

// The rows of both with the same seeds side by side; none where a seed is in one of them alone.
std::optional<std::vector<std::size_t>> pair_seeds(const Table& a, const Table& b,
                                                   const std::vector<std::size_t>& rows_a,
                                                   const std::vector<std::size_t>& rows_b,
                                                   const Texts& seeds) {
  if (rows_a.size() != rows_b.size()) return std::nullopt;
  for (const auto& seed : seeds)
    if (!is_axis(a, seed) || !is_axis(b, seed)) return std::nullopt;
  std::map<Texts, std::size_t> by_seed;
  for (const auto row : rows_b) by_seed[key_of(b, row, seeds)] = row;
  std::vector<std::size_t> paired;
  for (const auto row : rows_a) {
    const auto found = by_seed.find(key_of(a, row, seeds));
    if (found == by_seed.end()) return std::nullopt;
    paired.push_back(found->second);
  }
  return paired;
}

Value make_mean(const NamedTable& run, const std::vector<std::size_t>& rows,
                const std::string& column) {
  const auto numbers = numbers_at(run, rows, column);
  if (numbers.empty()) return {};
  return numbers.size() == 1 ? run.table.rows[rows[0]][*run.table.find(column)]
                             : Value(find_mean(numbers));
}

std::string format_interval(const Ratio& ratio) {
  if (!ratio.interval) return "";
  return fmt::format("{:.4g} to {:.4g}", ratio.interval->first, ratio.interval->second);
}

}  // namespace

bool is_seed(const std::string& axis) { return axis == "seed" || axis.ends_with("_seed"); }

Matched match_points(const std::vector<NamedTable>& runs) {
  Matched matched{.axes = choose_axes(runs), .points = {}, .seeds = {}, .left_out = {}};
  std::vector<Groups> groups(runs.size());
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (std::size_t row = 0; row < runs[r].table.rows.size(); ++row)
      groups[r][key_of(runs[r].table, row, matched.axes)].push_back(row);
    for (const auto& axis : axes_of(runs[r].table))
      if (is_seed(axis) && !contains(matched.seeds, axis)) matched.seeds.push_back(axis);
  }
  matched.left_out.resize(runs.size());
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (const auto& [key, rows] : groups[r]) {
      const bool everywhere =
          std::ranges::all_of(groups, [&](const Groups& g) { return g.contains(key); });
      if (!everywhere) matched.left_out[r] += rows.size();
    }
  std::set<Texts> taken;
  const Table& first = runs[0].table;
  for (std::size_t row = 0; row < first.rows.size(); ++row) {
    const auto key = key_of(first, row, matched.axes);
    if (!taken.insert(key).second) continue;
    Matched::Point point;
    for (const auto& axis : matched.axes) point.at.push_back(first.rows[row][*first.find(axis)]);
    for (const auto& g : groups)
      if (const auto found = g.find(key); found != g.end()) point.rows.push_back(found->second);
    if (point.rows.size() == runs.size()) matched.points.push_back(std::move(point));
  }
  if (matched.points.empty()) throw_apart(runs, matched.axes);
  return matched;
}

std::optional<Ratio> find_ratio(const std::vector<NamedTable>& runs, const Matched& matched,
                                const Matched::Point& point, std::size_t run,
                                const std::string& column) {
  const auto& rows_a = point.rows[0];
  const auto paired =
      pair_seeds(runs[0].table, runs[run].table, rows_a, point.rows[run], matched.seeds);
  const auto& rows_b = paired ? *paired : point.rows[run];
  const auto a = numbers_at(runs[0], rows_a, column), b = numbers_at(runs[run], rows_b, column);
  const auto is_positive = [](double x) { return std::isfinite(x) && x > 0; };
  if (a.size() < rows_a.size() || b.size() < rows_b.size() ||
      !std::ranges::all_of(a, is_positive) || !std::ranges::all_of(b, is_positive))
    return std::nullopt;
  Ratio ratio{.samples = std::min(a.size(), b.size())};
  if (a.size() == 1 && b.size() == 1) {
    ratio.value = b[0] / a[0];
    return ratio;
  }
  const auto logs_a = logs_of(a), logs_b = logs_of(b);
  ratio.value = std::exp(find_mean(logs_b) - find_mean(logs_a));
  if (ratio.samples < 2) return ratio;
  const auto found = paired ? estimate_pairs(logs_a, logs_b) : estimate_apart(logs_a, logs_b);
  ratio.interval = {std::exp(found.mean - found.half_width),
                    std::exp(found.mean + found.half_width)};
  return ratio;
}

Table compare_column(const std::vector<NamedTable>& runs, const Matched& matched,
                     const std::string& column) {
  Table table{.columns = matched.axes, .axes = matched.axes.size(), .rows = {}};
  bool has_intervals = false;
  std::vector<std::vector<std::optional<Ratio>>> ratios;
  for (const auto& point : matched.points) {
    auto& row = ratios.emplace_back();
    for (std::size_t r = 1; r < runs.size(); ++r) {
      row.push_back(find_ratio(runs, matched, point, r, column));
      has_intervals = has_intervals || (row.back() && row.back()->interval);
    }
  }
  for (const auto& run : runs) table.columns.push_back(fmt::format("{}: {}", run.name, column));
  for (std::size_t r = 1; r < runs.size(); ++r) {
    table.columns.push_back(fmt::format("{} / {}", runs[r].name, runs[0].name));
    if (has_intervals) table.columns.push_back(table.columns.back() + ", 95 %");
  }
  for (std::size_t p = 0; p < matched.points.size(); ++p) {
    const auto& point = matched.points[p];
    auto& row = table.rows.emplace_back(point.at);
    for (std::size_t r = 0; r < runs.size(); ++r)
      row.push_back(make_mean(runs[r], point.rows[r], column));
    for (const auto& ratio : ratios[p]) {
      auto& value = row.emplace_back();
      if (ratio) value = ratio->value;
      if (!has_intervals) continue;
      auto& interval = row.emplace_back();
      if (ratio) interval = format_interval(*ratio);
    }
  }
  return table;
}

std::optional<Spread> find_spread(const std::vector<NamedTable>& runs, const Matched& matched,
                                  std::size_t run, const std::string& column) {
  Spread spread;
  double logs = 0;
  for (const auto& point : matched.points) {
    const auto ratio = find_ratio(runs, matched, point, run, column);
    if (!ratio) continue;
    logs += std::log(ratio->value);
    if (spread.points == 0 || ratio->value < spread.least) {
      spread.least = ratio->value;
      spread.least_at = &point;
    }
    if (spread.points == 0 || ratio->value > spread.most) {
      spread.most = ratio->value;
      spread.most_at = &point;
    }
    ++spread.points;
    if (!ratio->interval) continue;
    ++spread.with_interval;
    spread.surely_less += ratio->interval->second < 1;
    spread.surely_more += ratio->interval->first > 1;
  }
  if (spread.points == 0) return std::nullopt;
  spread.mean = std::exp(logs / static_cast<double>(spread.points));
  return spread;
}

std::string tell_spread(const std::vector<NamedTable>& runs, const Matched& matched,
                        std::size_t run, const std::string& column, const Spread& spread) {
  const auto name = [&](double ratio, const Matched::Point& point) {
    auto text = fmt::format("{:.4g}", ratio);
    if (!matched.axes.empty())
      text +=
          " at " + name_point(matched.axes, key_of(runs[0].table, point.rows[0][0], matched.axes));
    return text;
  };
  if (spread.is_same())
    return fmt::format("{}: {} is the same as {}", column, runs[run].name, runs[0].name);
  std::string text =
      fmt::format("{}: {} is {:.4g} of {}", column, runs[run].name, spread.mean, runs[0].name);
  if (spread.points > 1)
    text += fmt::format(" (geometric mean of {} points; {} to {})", spread.points,
                        name(spread.least, *spread.least_at), name(spread.most, *spread.most_at));
  if (spread.with_interval > 0)
    text += fmt::format("; by its seeds surely less (95 %) at {}, surely more at {} of {} points",
                        spread.surely_less, spread.surely_more, spread.with_interval);
  return text;
}

std::vector<std::string> common_results(const std::vector<NamedTable>& runs) {
  Texts columns;
  for (const auto& column : runs[0].table.columns) {
    const bool everywhere = std::ranges::all_of(runs, [&](const NamedTable& run) {
      const auto c = run.table.find(column);
      return c && *c >= run.table.axes && is_numeric(run.table, *c);
    });
    if (everywhere) columns.push_back(column);
  }
  return columns;
}

Table stack_runs(const std::vector<NamedTable>& runs, const Matched& matched,
                 const std::vector<std::string>& columns) {
  Table table{.columns = {"run"}, .axes = 1 + matched.axes.size(), .rows = {}};
  table.columns.insert(table.columns.end(), matched.axes.begin(), matched.axes.end());
  table.columns.insert(table.columns.end(), columns.begin(), columns.end());
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (const auto& point : matched.points) {
      auto& row = table.rows.emplace_back();
      row.emplace_back(runs[r].name);
      row.insert(row.end(), point.at.begin(), point.at.end());
      for (const auto& column : columns) row.push_back(make_mean(runs[r], point.rows[r], column));
    }
  return table;
}

}  // namespace laboratory
