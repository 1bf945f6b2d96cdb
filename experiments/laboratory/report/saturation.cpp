#include "experiments/laboratory/report/saturation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

namespace laboratory {
namespace {

using Columns = programs::SaturationColumns;
using Texts = std::vector<std::string>;

bool are_saturated(const Table& table, const RowList& rows, std::size_t mark) {
  const auto marks = numbers_of(table, rows, mark);
  const auto saturated = std::ranges::count_if(marks, [](double value) { return value != 0; });
  return saturated > 0 && 2 * static_cast<std::size_t>(saturated) >= marks.size();
}

// True for each load, ascending, at which the rows are beyond saturation.
std::map<double, bool> find_loads(const Table& table, const RowList& rows, std::size_t load,
                                  std::size_t mark) {
  std::map<double, RowList> rows_at;
  for (const auto row : rows)
    if (const auto at = as_number(table.rows[row][load]); at && as_number(table.rows[row][mark]))
      rows_at[*at].push_back(row);
  std::map<double, bool> loads;
  for (const auto& [at, same] : rows_at) loads[at] = are_saturated(table, same, mark);
  return loads;
}

std::string describe_loads(const std::map<double, bool>& loads, const std::string& name) {
  auto from = loads.end();
  while (from != loads.begin() && std::prev(from)->second) --from;
  Texts earlier;  // loads that are saturated although a larger one is not
  for (auto at = loads.begin(); at != from; ++at)
    if (at->second) earlier.push_back(fmt::format("{:.4g}", at->first));
  const auto others = join_texts(earlier, ", ");
  if (from != loads.end())
    return fmt::format("saturated from {} {:.4g} on{}", name, from->first,
                       others.empty() ? "" : fmt::format(", and at {}", others));
  const auto last = loads.rbegin()->first;
  return others.empty() ? fmt::format("not saturated up to {} {:.4g}", name, last)
                        : fmt::format("saturated at {} {}, but not at {:.4g}", name, others, last);
}

std::string describe_bound(const Table& table, const RowList& rows, const Columns& columns) {
  const auto bound = table.find(columns.bound);
  if (!bound) return "";
  const auto bounds = numbers_of(table, rows, *bound);
  return bounds.empty() ? "" : fmt::format("; the {} is {:.3g}", columns.bound_name, bounds[0]);
}

// Puts the values of the axes before a sentence: "pattern = transpose: saturated".
std::string begin_sentence(const Table& table, std::size_t row,
                           const std::vector<std::size_t>& axes, std::string sentence) {
  Texts values;
  for (const auto axis : axes)
    values.push_back(fmt::format("{} = {}", table.columns[axis], to_string(table.rows[row][axis])));
  if (!values.empty()) return fmt::format("{}: {}", join_texts(values, ", "), sentence);
  sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
  return sentence;
}

}  // namespace

void mark_saturated(Plot& plot, const Table& table, const Columns& columns) {
  const auto mark = table.find(columns.mark);
  if (!mark) return;
  std::vector<Series> marked;
  std::size_t curves = 0;
  for (const auto& curve : plot.series) {
    if (curve.kind != SeriesKind::curve) continue;
    Series beyond{.name = "", .x = {}, .y = {}, .kind = SeriesKind::saturated, .of = curves++};
    for (std::size_t k = 0; k < curve.rows.size(); ++k) {
      const auto rows = curve.samples.empty() ? RowList{curve.rows[k]} : curve.samples[k].rows;
      if (!are_saturated(table, rows, *mark)) continue;
      beyond.x.push_back(curve.x[k]);
      beyond.y.push_back(curve.y[k]);
    }
    if (!beyond.x.empty() && !curve.is_stepped) marked.push_back(std::move(beyond));
  }
  if (!marked.empty()) marked[0].name = "beyond saturation";
  plot.series.insert(plot.series.end(), marked.begin(), marked.end());
}

Texts tell_saturation(const Table& table, const Columns& columns) {
  constexpr std::size_t MOST = 12;
  const auto load = table.find(columns.load), mark = table.find(columns.mark);
  if (!load || !mark || *load >= table.axes || !is_numeric(table, *load) ||
      distinct(table, all_rows(table), *load).size() < 2)
    return {};
  const auto axes = choose_series_axes(table, all_rows(table), {*load});
  std::map<std::vector<Value>, std::size_t> known;  // index in `groups`
  std::vector<RowList> groups;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    std::vector<Value> values;
    for (const auto axis : axes) values.push_back(table.rows[row][axis]);
    const auto [group, is_new] = known.emplace(values, groups.size());
    if (is_new) groups.emplace_back();
    groups[group->second].push_back(row);
  }
  Texts sentences;
  for (const auto& rows : groups)
    if (const auto loads = find_loads(table, rows, *load, *mark); !loads.empty())
      sentences.push_back(
          begin_sentence(table, rows[0], axes,
                         fmt::format("{}{}.", describe_loads(loads, make_label(columns.load)),
                                     describe_bound(table, rows, columns))));
  if (sentences.size() <= MOST) return sentences;
  const auto more = fmt::format("Saturation of {} more series: see the column {}.",
                                sentences.size() - MOST, columns.mark);
  sentences.resize(MOST);
  sentences.push_back(more);
  return sentences;
}

}  // namespace laboratory
