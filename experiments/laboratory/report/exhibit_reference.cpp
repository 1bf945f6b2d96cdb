// Numbers from elsewhere in a declared figure.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "experiments/laboratory/report/exhibit_parts.hpp"

namespace laboratory {
namespace {

double round_to(double value, double step) { return std::round(value / step) * step; }

// Both of one curve: the published points, and by how much the simulated ones are off.
struct Compared {
  Series reference, difference;
};

Compared compare_curve(Table& differences, const CheckPlan::Figure& figure, const Curve& curve,
                       const std::vector<std::optional<double>>& published) {
  const auto name = (curve.name.empty() ? "" : curve.name + ", ") + figure.spec.reference_name;
  Compared compared{{.name = name, .x = {}, .y = {}, .kind = SeriesKind::reference},
                    {.name = "", .x = {}, .y = {}}};
  for (std::size_t i = 0; i < curve.rows.size(); ++i) {
    const auto& value = published[curve.rows[i]];
    if (!value) continue;
    const double percent = 100 * (curve.y[i] - *value) / std::abs(*value);
    compared.reference.x.push_back(curve.x[i]);
    compared.reference.y.push_back(*value);
    compared.difference.x.push_back(curve.x[i]);
    compared.difference.y.push_back(percent);
    differences.rows.push_back(
        {curve.name, to_cell(curve.x[i]), curve.y[i], *value, round_to(percent, 0.01)});
  }
  return compared;
}

// Of each row of the table what the reference says of it.
std::vector<std::optional<double>> find_published(Exhibit& exhibit, const CheckPlan::Figure& figure,
                                                  const Table& table) {
  const auto& [spec, reference] = std::tie(figure.spec, *figure.reference);
  std::vector<std::optional<double>> published(table.rows.size());
  const auto matches = match_rows(reference, table, spec.keys);
  for (std::size_t i = 0; i < matches.size(); ++i)
    for (const auto row : matches[i])
      published[row] = as_number(reference.rows[i][*reference.find(spec.column)]);
  if (auto note = note_missing(reference, spec.reference, spec.column, spec.keys, matches))
    exhibit.notes.push_back(*note);
  return published;
}

void tell_differences(Exhibit& exhibit, const std::string& reference_name) {
  const auto& rows = exhibit.differences.rows;
  if (rows.empty()) return;
  double mean = 0, worst = 0;
  for (const auto& row : rows) {
    const double size = std::abs(*as_number(row.back()));
    mean += size / static_cast<double>(rows.size());
    worst = std::max(worst, size);
  }
  exhibit.findings.push_back(
      fmt::format("{}: {:.1f} % from the {} on average, {:.1f} % at worst, "
                  "of {} points.",
                  exhibit.plot.title, mean, reference_name, worst, rows.size()));
}

}  // namespace

void add_reference(Exhibit& exhibit, const CheckPlan::Figure& figure, const Rows& rows,
                   const std::vector<Curve>& curves) {
  const auto published = find_published(exhibit, figure, rows.table());
  exhibit.differences.columns = {"series", figure.spec.x, "predicted", figure.spec.reference_name,
                                 "difference %"};
  exhibit.differences.axes = 2;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    auto compared = compare_curve(exhibit.differences, figure, curves[i], published);
    if (compared.reference.x.empty()) continue;
    compared.reference.of = compared.difference.of = i;
    exhibit.plot.series.push_back(std::move(compared.reference));
    exhibit.plot.differences.push_back(std::move(compared.difference));
  }
  exhibit.plot.difference_label = "difference [%]";
  tell_differences(exhibit, figure.spec.reference_name);
}

}  // namespace laboratory
