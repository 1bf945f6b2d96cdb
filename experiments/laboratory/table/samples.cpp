#include "experiments/laboratory/table/samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/errors.hpp"
#include "experiments/laboratory/table/statistics.hpp"

namespace laboratory {
namespace {

constexpr double BELOW = 0.975;  // probability below the upper end of a two-sided 95 % interval

double find_half_width(double standard_error, double degrees_of_freedom) {
  return standard_error == 0 ? 0 : student_t(BELOW, degrees_of_freedom) * standard_error;
}

// Spells the values of a row's axes: only of the seeds if `are_seeds`, else of all other axes.
std::vector<std::string> spell_axes(const Table& table, std::size_t row,
                                    const std::vector<std::size_t>& seeds, bool are_seeds) {
  std::vector<std::string> texts;
  for (std::size_t axis = 0; axis < table.axes; ++axis) {
    if ((std::ranges::find(seeds, axis) != seeds.end()) != are_seeds) continue;
    const auto& cell = table.rows[row][axis];
    const auto number = as_number(cell);
    texts.push_back(to_string(number ? to_cell(*number) : cell));
  }
  return texts;
}

}  // namespace

bool is_seed(std::string_view axis) { return axis == "seed" || axis.ends_with("_seed"); }

std::vector<std::size_t> find_seeds(const Table& table) {
  std::vector<std::size_t> seeds;
  for (std::size_t axis = 0; axis < table.axes; ++axis)
    if (is_seed(table.columns[axis]) && distinct(table, all_rows(table), axis).size() > 1)
      seeds.push_back(axis);
  return seeds;
}

std::vector<RowList> group_samples(const Table& table, const RowList& rows) {
  std::vector<RowList> groups;
  const auto seeds = find_seeds(table);
  std::map<std::vector<std::string>, std::size_t> known;
  for (const auto row : rows) {
    if (seeds.empty()) {
      groups.push_back({row});
      continue;
    }
    const auto [at, is_new] = known.emplace(spell_axes(table, row, seeds, false), groups.size());
    if (is_new) groups.emplace_back();
    groups[at->second].push_back(row);
  }
  return groups;
}

std::vector<std::size_t> number_samples(const Table& table) {
  std::vector<std::size_t> numbers(table.rows.size());
  const auto groups = group_samples(table, all_rows(table));
  for (std::size_t i = 0; i < groups.size(); ++i)
    for (const auto row : groups[i]) numbers[row] = i;
  return numbers;
}

std::string name_seeds(const Table& table) {
  std::vector<std::string> parts;
  for (const auto axis : find_seeds(table)) {
    std::vector<std::string> values;
    for (const auto& value : distinct(table, all_rows(table), axis))
      values.push_back(to_string(value));
    parts.push_back(fmt::format("{} = {}", table.columns[axis], join_texts(values, ", ")));
  }
  return join_texts(parts, "; ");
}

MeanInterval find_mean_interval(const std::vector<double>& samples) {
  MeanInterval found{find_mean(samples), samples.size()};
  if (samples.size() < 2) return found;
  // For equal samples, sets mean and half width exactly, since the formulas would give rounding
  // errors.
  const bool are_equal = std::ranges::all_of(samples, [&](double s) { return s == samples[0]; });
  if (are_equal) found.mean = samples[0];
  const auto n = static_cast<double>(samples.size());
  found.half_width = are_equal ? 0 : find_half_width(find_deviation(samples) / std::sqrt(n), n - 1);
  return found;
}

MeanInterval find_paired_difference(const std::vector<double>& a, const std::vector<double>& b) {
  base::check_equal("samples of a pair", b.size(), a.size());
  std::vector<double> differences;
  for (std::size_t i = 0; i < a.size(); ++i) differences.push_back(b[i] - a[i]);
  return find_mean_interval(differences);
}

MeanInterval find_difference(const std::vector<double>& a, const std::vector<double>& b) {
  MeanInterval found{find_mean(b) - find_mean(a), std::min(a.size(), b.size())};
  if (found.samples < 2) return found;
  const auto na = static_cast<double>(a.size()), nb = static_cast<double>(b.size());
  const double va = find_variance(a) / na, vb = find_variance(b) / nb;
  const double degrees = (va + vb) * (va + vb) / (va * va / (na - 1) + vb * vb / (nb - 1));
  found.half_width = find_half_width(std::sqrt(va + vb), degrees);
  return found;
}

MeanInterval compare_samples(const Table& table, const RowSamples& a, const RowSamples& b) {
  const auto seeds = find_seeds(table);
  std::map<std::vector<std::string>, double> of_seed;
  for (std::size_t i = 0; i < b.rows.size(); ++i)
    of_seed.emplace(spell_axes(table, b.rows[i], seeds, true), b.values[i]);
  std::vector<double> paired;
  for (const auto row : a.rows)
    if (const auto found = of_seed.find(spell_axes(table, row, seeds, true));
        found != of_seed.end())
      paired.push_back(found->second);
  const bool are_pairs = paired.size() == a.rows.size() && paired.size() == b.rows.size();
  return are_pairs ? find_paired_difference(a.values, paired) : find_difference(a.values, b.values);
}

}  // namespace laboratory
