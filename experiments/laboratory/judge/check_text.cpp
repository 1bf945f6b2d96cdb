// The outcome of checks as lines and tables.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "experiments/laboratory/judge/check_results.hpp"

namespace laboratory {

namespace {

constexpr std::size_t WORST_SHOWN = 10;

std::string format_error(const Check& check, double error) {
  if (std::isnan(error)) return "not a number";
  if (std::isinf(error)) return "infinite";
  return check.is_absolute() ? fmt::format("{:.3g}", error) : fmt::format("{:.3g} %", 100 * error);
}

// Which points to show: all in their order, or the worst first.
std::vector<std::size_t> choose_points(const CheckResult& result, std::size_t most) {
  std::vector<std::size_t> order(result.points.size());
  std::iota(order.begin(), order.end(), 0);
  if (order.size() <= most) return order;
  std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) {
    const double error = result.points[i].error;
    return std::isnan(error) ? INFINITY : std::abs(error);
  });
  order.resize(std::min(WORST_SHOWN, order.size()));
  return order;
}

Value kind_of(const Check& check, const CheckedPoint& point) {
  if (check.calibrated.empty()) return {};
  return point.is_calibrated ? "calibrated" : "predicted";
}

double without_sign_of_nan(double value) { return std::isnan(value) ? NAN : value; }

}  // namespace

std::string summarize(const CheckResult& result, const Table& table) {
  const Check& check = result.check;
  if (result.verdict == Verdict::unmatched)
    return fmt::format("no point {}: {} has no point that it speaks of", check.name, check.of);
  const auto& worst = result.points[result.worst];
  std::string line =
      fmt::format("{:<8} {}: {} at {} point(s), worst error {}",
                  result.verdict == Verdict::holds ? "ok" : "FAILED", check.name, check.of,
                  result.points.size(), format_error(check, std::abs(worst.error)));
  if (!std::isfinite(worst.error))
    line += fmt::format(" (simulated {}, expected {})", without_sign_of_nan(worst.simulated),
                        without_sign_of_nan(worst.expected));
  if (const auto limit = check.is_absolute() ? check.within_abs : check.within)
    line += fmt::format(" (within {})", format_error(check, *limit));
  if (table.axes > 0 && worst.error != 0) line += " at " + name_axes(table, worst.row);
  if (check.within_mean)
    line += fmt::format("; mean {} (within {})", format_error(check, result.mean),
                        format_error(check, *check.within_mean));
  if (const auto& p = result.predicted)
    line += fmt::format("; of the {} predicted alone: mean {}, worst {}", p->points,
                        format_error(check, p->mean),
                        format_error(check, std::abs(result.points[p->worst].error)));
  return line;
}

Table make_check_table(const CheckResult& result, const Table& table, std::size_t most) {
  const Check& check = result.check;
  Table shown;
  shown.columns.assign(table.columns.begin(),
                       table.columns.begin() + static_cast<std::ptrdiff_t>(table.axes));
  shown.axes = table.axes;
  for (const char* column : {"simulated", check.formula.empty() ? "reference" : "formula",
                             check.is_absolute() ? "error" : "error %"})
    shown.columns.emplace_back(column);
  if (!check.calibrated.empty()) shown.columns.emplace_back("kind");
  shown.columns.emplace_back("mark");
  for (const std::size_t i : choose_points(result, most)) {
    const auto& p = result.points[i];
    const auto& axes = table.rows[p.row];
    auto& row = shown.rows.emplace_back(axes.begin(),
                                        axes.begin() + static_cast<std::ptrdiff_t>(table.axes));
    std::string mark = p.holds ? "" : "fails";
    if (i == result.worst && p.error != 0) mark += mark.empty() ? "worst" : ", worst";
    row.emplace_back(fmt::format("{:.5g}", without_sign_of_nan(p.simulated)));
    row.emplace_back(fmt::format("{:.5g}", without_sign_of_nan(p.expected)));
    row.emplace_back(without_sign_of_nan(check.is_absolute() ? p.error : 100 * p.error));
    if (!check.calibrated.empty()) row.emplace_back(kind_of(check, p));
    row.emplace_back(mark);
  }
  return shown;
}

Table make_checks_csv(const std::vector<CheckResult>& results, const Table& table) {
  Table csv;
  csv.columns = {"check"};
  csv.columns.insert(csv.columns.end(), table.columns.begin(),
                     table.columns.begin() + static_cast<std::ptrdiff_t>(table.axes));
  csv.axes = csv.columns.size();
  for (const char* column : {"simulated", "expected", "error", "kind"})
    csv.columns.emplace_back(column);
  for (const auto& result : results)
    for (const auto& p : result.points) {
      auto& row = csv.rows.emplace_back(std::vector<Value>{result.check.name});
      for (std::size_t c = 0; c < table.axes; ++c) row.push_back(table.rows[p.row][c]);
      for (const double value : {p.simulated, p.expected, p.error})
        row.emplace_back(without_sign_of_nan(value));
      row.emplace_back(kind_of(result.check, p));
    }
  return csv;
}

}  // namespace laboratory
