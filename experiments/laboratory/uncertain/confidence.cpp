#include "experiments/laboratory/uncertain/confidence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/errors.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/points/results.hpp"
#include "experiments/laboratory/table/statistics.hpp"
#include "experiments/laboratory/uncertain/draw.hpp"

namespace laboratory {

namespace {

constexpr const char *INTERVALS = "intervals.csv", *ASSUMPTIONS = "assumptions.csv";

std::string of_rows(std::size_t rows) {
  return rows > 1 ? fmt::format(" (the median of {} rows)", rows) : "";
}

// Reads a row of intervals.csv or assumptions.csv. The table may be computed or loaded from a file.
class Reader {
 public:
  Reader(const Table& table, std::size_t row) : table_(table), row_(row) {}
  std::string text(std::string_view column) const { return to_string(cell(column)); }
  double number(std::string_view column) const { return as_number(cell(column)).value_or(0); }
  // The values of the row's axes as text, one on each line. The axes are the columns before the
  // column "column".
  std::string axes() const {
    std::string text;
    for (std::size_t c = 0; c < *table_.find("column"); ++c)
      text += to_string(table_.rows[row_][c]) + "\n";
    return text;
  }

 private:
  const Value& cell(std::string_view column) const {
    return table_.rows[row_][*table_.find(column)];
  }
  const Table& table_;
  std::size_t row_;
};

// Formats a share in percent with two digits: "3.2", "480".
std::string in_percent(double share) {
  const double percent = 100 * share;
  return std::abs(percent) < 99.5 ? fmt::format("{:.2g}", percent) : fmt::format("{:.0f}", percent);
}

std::string tell_weights(const std::vector<Weight>& weights) {
  constexpr std::size_t MOST_TOLD = 5;
  auto text = fmt::format("{} matters most: ± {} %{}", weights[0].entry,
                          in_percent(std::abs(weights[0].share)), of_rows(weights[0].rows));
  for (std::size_t i = 1; i < std::min(MOST_TOLD, weights.size()); ++i)
    text += fmt::format("{}{} ± {} %", i == 1 ? "; then " : ", ", weights[i].entry,
                        in_percent(std::abs(weights[i].share)));
  return text;
}

void each_of(const Table& table, const std::string& column, auto visit) {
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    if (const Reader reader(table, row); reader.text("column") == column) visit(reader);
}

}  // namespace

Confidence find_confidence(const ExperimentFile& file, const Table& table, const Results& results) {
  Confidence confidence;
  confidence.entries = drawn_entries(file);
  confidence.quantiles.resize(confidence.entries.size());
  const auto drawn = static_cast<std::size_t>(file.uncertain.machines);
  const auto seed = static_cast<std::uint64_t>(file.uncertain.seed);
  const std::size_t points = file.points.size();
  std::vector<std::vector<double>> all;  // for each entry, its quantile on each machine
  for (const auto& entry : confidence.entries) all.push_back(draw_quantiles(seed, entry, drawn));
  std::vector<Table> tables;
  for (std::size_t machine = 0; machine < drawn; ++machine) {
    const auto first = results.begin() + static_cast<std::ptrdiff_t>((machine + 1) * points);
    const Results own(first, first + static_cast<std::ptrdiff_t>(points));
    if (!std::ranges::all_of(own, &PointResult::is_complete)) {
      ++confidence.left_out;
      continue;
    }
    tables.push_back(make_table(file, own));
    for (std::size_t i = 0; i < confidence.entries.size(); ++i)
      confidence.quantiles[i].push_back(all[i][machine]);
  }
  confidence.machines = tables.size();
  if (tables.size() >= LEAST_MACHINES) confidence.intervals = find_intervals(table, tables);
  return confidence;
}

namespace {

Table make_assumptions_table(const Table& table, const Confidence& confidence) {
  Table made =
      start_table(table, {"column", "entry", "swing", "standard_error", "rank_correlation"});
  for (const auto& interval : confidence.intervals) {
    const auto influences =
        find_influences(interval.machines, confidence.entries, confidence.quantiles);
    for (const auto& influence : influences) {
      auto cells = take_axes(table, interval.row);
      cells.emplace_back(table.columns[interval.column]);
      cells.emplace_back(influence.entry);
      for (const double number : {influence.swing, influence.error, influence.correlation})
        cells.emplace_back(number);
      made.rows.push_back(std::move(cells));
    }
  }
  return made;
}

// Formats an interval relative to its value: "± 3.2 %", or with two bounds, "-20 % to +80 %", if
// the interval is wide or does not contain the value.
std::string tell_bounds(double below, double above) {
  constexpr double WIDE = 0.3;
  const double half = (above - below) / 2;
  if (below <= 0 && above >= 0 && half <= WIDE) return fmt::format("± {} %", in_percent(half));
  const auto sign = [](double share) { return share < 0 ? "" : "+"; };
  return fmt::format("{}{} % to {}{} %", sign(below), in_percent(below), sign(above),
                     in_percent(above));
}

Table load_table(const std::filesystem::path& file) {
  auto table = parse_csv(base::read_own_text(file), file.string());
  base::require(table.find("column").has_value(), file.string(), "damaged: no column \"column\"");
  return table;
}

}  // namespace

ConfidenceTables make_confidence_tables(const Table& table, const Confidence& confidence) {
  return {make_intervals_table(table, confidence.intervals),
          make_assumptions_table(table, confidence)};
}

void save_confidence(const std::filesystem::path& folder, const ConfidenceTables& tables) {
  base::save_whole(folder / INTERVALS, to_csv(tables.intervals));
  base::save_whole(folder / ASSUMPTIONS, to_csv(tables.assumptions));
}

std::optional<ConfidenceTables> load_confidence(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder / INTERVALS)) return {};
  return ConfidenceTables{load_table(folder / INTERVALS), load_table(folder / ASSUMPTIONS)};
}

std::optional<std::pair<double, double>> find_interval(const ConfidenceTables& confidence,
                                                       const Table& table, std::size_t row,
                                                       const std::string& column) {
  std::string axes;
  for (std::size_t c = 0; c < table.axes; ++c) axes += to_string(table.rows[row][c]) + "\n";
  std::optional<std::pair<double, double>> found;
  each_of(confidence.intervals, column, [&](const Reader& reader) {
    if (reader.axes() == axes) found.emplace(reader.number("p5"), reader.number("p95"));
  });
  return found;
}

std::vector<Weight> weigh(const ConfidenceTables& confidence, const std::string& column) {
  std::map<std::string, double> values;  // results of the nominal model, by the row's axes
  each_of(confidence.intervals, column,
          [&](const Reader& row) { values[row.axes()] = row.number("value"); });
  // relative influences of each entry, one for each row
  std::map<std::string, std::vector<double>> shares;
  each_of(confidence.assumptions, column, [&](const Reader& row) {
    const auto value = values.find(row.axes());
    if (value != values.end() && value->second != 0)
      shares[row.text("entry")].push_back(row.number("swing") / 2 / value->second);
  });
  std::vector<Weight> weights;
  for (const auto& [entry, all] : shares) weights.push_back({entry, find_median(all), all.size()});
  std::ranges::stable_sort(weights, std::greater(), [](const Weight& weight) {
    return std::pair(weight.rows, std::abs(weight.share));
  });
  return weights;
}

std::vector<std::string> describe_confidence(const ConfidenceTables& confidence,
                                             const std::vector<std::string>& columns) {
  std::vector<std::string> sentences;
  for (const auto& column : columns) {
    // for each row, distances of the interval's ends from the value, relative to the value
    std::vector<double> below, above;
    each_of(confidence.intervals, column, [&](const Reader& row) {
      const double value = row.number("value");
      if (value == 0) return;
      below.push_back((row.number("p5") - value) / std::abs(value));
      above.push_back((row.number("p95") - value) / std::abs(value));
    });
    if (below.empty()) continue;
    auto text =
        fmt::format("{}: {} on nine of ten machines{}", column,
                    tell_bounds(find_median(below), find_median(above)), of_rows(below.size()));
    const auto weights = weigh(confidence, column);
    if (weights.empty())
      text += "; no single assumption stands out among so few machines";
    else
      text += "; of the assumptions, " + tell_weights(weights);
    sentences.push_back(std::move(text));
  }
  return sentences;
}

}  // namespace laboratory
