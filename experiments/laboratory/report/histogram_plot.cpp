#include "experiments/laboratory/report/histogram_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace laboratory {
namespace {

// The number of values in each bin, by its lower bound.
struct Counts {
  struct Bin {
    double high, count;
  };
  std::map<double, Bin> bins = {};
  double all = 0;
  std::string of = {};  // what is counted
  std::size_t row = 0;  // the first row of the results that is counted
};

void add_point(Counts& counts, const Table& histograms, const std::string& quantity,
               std::size_t point) {
  const auto cell = [&](const auto& row, const char* column) -> const Value& {
    return row[*histograms.find(column)];
  };
  const auto of_point = std::ranges::equal_range(histograms.points, point);
  for (auto at = of_point.begin(); at != of_point.end(); ++at) {
    const auto& row = histograms.rows[static_cast<std::size_t>(at - histograms.points.begin())];
    if (to_string(cell(row, "quantity")) != quantity) continue;
    const double count = *as_number(cell(row, "count"));
    auto& bin = counts.bins[*as_number(cell(row, "low"))];
    bin = {*as_number(cell(row, "high")), bin.count + count};
    counts.all += count;
    counts.of = to_string(cell(row, "of"));
  }
}

// Makes the steps: from a bin's lower bound on, y is its share.
Series make_steps(const std::string& name, const Counts& counts) {
  Series steps{.name = name, .x = {}, .y = {}, .is_stepped = true};
  const auto add = [&](double x, double y) {
    steps.x.push_back(x);
    steps.y.push_back(y);
    steps.rows.push_back(counts.row);
  };
  double end = counts.bins.begin()->first;
  add(end, 0);
  for (const auto& [low, bin] : counts.bins) {
    if (low > end) add(end, 0);  // no bin begins where the last one ends
    add(low, bin.count / counts.all);
    end = bin.high;
  }
  add(end, 0);
  return steps;
}

}  // namespace

Plot plot_histogram(const Table& histograms, const std::string& quantity, const Table& table,
                    const RowList& rows, const std::vector<std::size_t>& series) {
  std::vector<std::pair<std::string, Counts>> all;
  std::set<std::size_t> counted;
  for (const auto row : rows) {
    if (!counted.insert(table.point_of(row)).second) continue;
    const auto name = name_values(table, row, series);
    auto same = std::ranges::find(all, name, &std::pair<std::string, Counts>::first);
    if (same == all.end()) same = all.insert(all.end(), {name, {.row = row}});
    add_point(same->second, histograms, quantity, table.point_of(row));
  }
  Plot plot;
  plot.x_label = make_label(quantity);
  plot.log_x = true;
  plot.y_min = 0;
  for (const auto& [name, counts] : all) {
    if (counts.all == 0) continue;
    plot.series.push_back(make_steps(name, counts));
    plot.y_label = "share of " + counts.of;
    plot.log_x = plot.log_x && counts.bins.begin()->first > 0;
  }
  plot.legend_title = label_series(plot.series, table, series);
  return plot;
}

}  // namespace laboratory
