// Where the curves of a declared figure are largest.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/laboratory/report/exhibit_parts.hpp"

namespace laboratory {
namespace {

constexpr double LEVEL = 0.01;  // a curve that falls by less than this share does not fall

// What a curve does after its largest value.
std::string describe_after(const Curve& curve, std::size_t best, bool& falls) {
  const double most = curve.y[best];
  const double least_after =
      *std::ranges::min_element(curve.y.begin() + std::ptrdiff_t(best), curve.y.end());
  falls = least_after < most - LEVEL * std::abs(most);
  if (falls) return fmt::format("turns down after {:g}", curve.x[best]);
  const auto level =
      std::ranges::find_if(curve.y, [&](double y) { return y >= most - LEVEL * std::abs(most); });
  const auto from = static_cast<std::size_t>(level - curve.y.begin());
  if (from + 1 < curve.y.size()) return fmt::format("levels off at {:g}", curve.x[from]);
  return fmt::format("still rising at {:g}", curve.x.back());
}

}  // namespace

void add_optima(Exhibit& exhibit, const CheckPlan::Figure& figure,
                const std::vector<Curve>& curves) {
  const auto& y = figure.spec.y;
  const std::string of_y = y.size() == 1 && base::Formula::is_name(y[0]) ? y[0] : "y";
  exhibit.optima.columns = {"series", "largest_" + of_y, "at_" + figure.spec.x, "then"};
  exhibit.optima.axes = 1;
  bool is_first = true;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const Curve& curve = curves[i];
    const auto best = static_cast<std::size_t>(std::ranges::max_element(curve.y) - curve.y.begin());
    bool falls = false;
    const auto after = describe_after(curve, best, falls);
    exhibit.optima.rows.push_back({curve.name, curve.y[best], to_cell(curve.x[best]), after});
    exhibit.findings.push_back(fmt::format("{}{} {} {}.", describe(curve.name),
                                           exhibit.plot.y_label, after, exhibit.plot.x_label));
    if (!falls) continue;
    exhibit.plot.series.push_back({.name = is_first ? "largest, falls afterwards" : "",
                                   .x = {curve.x[best]},
                                   .y = {curve.y[best]},
                                   .kind = SeriesKind::mark,
                                   .of = i});
    is_first = false;
  }
}

}  // namespace laboratory
