#include "experiments/laboratory/judge/check_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/errors.hpp"
#include "experiments/laboratory/points/results.hpp"

namespace laboratory {
namespace {

constexpr double NO_VALUE = std::numeric_limits<double>::quiet_NaN();
constexpr double NO_LIMIT = 1e300;
constexpr std::size_t WORST_SHOWN = 10;
constexpr const char* KIND_NAMES[] = {"", "predicted", "calibrated", "at_least", "at_most"};

// The size of an error. NaN counts as infinite.
double size_of(double error) { return std::isnan(error) ? INFINITY : std::abs(error); }

// The sort key for the worst point: its error, or for a point within bounds the negative distance
// to the nearer bound.
double badness(const Check& check, const CheckedPoint& point) {
  if (check.has_bounds() && point.holds) return -std::abs(point.simulated - point.expected);
  return size_of(point.error);
}

CheckedPoint compare(const Check& check, std::size_t row, double simulated, double expected) {
  double error = simulated - expected;
  if (!check.is_absolute() && error != 0) error /= std::abs(expected);
  if (!std::isfinite(simulated) || !std::isfinite(expected)) error = NO_VALUE;
  const auto limit = check.is_absolute() ? check.within_abs : check.within;
  return {row, simulated, expected, error, size_of(error) <= limit.value_or(NO_LIMIT)};
}

// Compares a value with one or two bounds.
CheckedPoint compare_bounds(std::size_t row, double simulated, std::optional<double> low,
                            std::optional<double> high) {
  const bool is_low = low && (!high || simulated - *low < *high - simulated);
  const double bound = is_low ? *low : *high;
  const bool holds =
      std::isfinite(simulated) && (!low || simulated >= *low) && (!high || simulated <= *high);
  const bool are_numbers = std::isfinite(simulated + low.value_or(0) + high.value_or(0));
  const double beyond = are_numbers ? simulated - bound : NO_VALUE;
  return {
      row, simulated, bound, holds ? 0 : beyond, holds, is_low ? Kind::at_least : Kind::at_most};
}

// The checked value of a point; none for an empty cell, such as the speed-up if no row has one
// worker.
std::optional<double> find_simulated(const CheckPlan::Comparison& c, const Rows& rows,
                                     std::size_t row) {
  if (c.of) return rows.eval(*c.of, row);
  const Table& table = rows.table();
  return as_number(table.rows[row][*table.find(c.check.of)]);
}

// Adds a point to the check if both values exist.
void add_point(CheckResult& result, const CheckPlan::Comparison& c, const Rows& rows,
               std::size_t row, std::optional<double> expected,
               std::vector<std::size_t>& left_out) {
  const auto simulated = find_simulated(c, rows, row);
  if (!simulated || !expected) return left_out.push_back(row);
  auto& point = result.points.emplace_back(compare(c.check, row, *simulated, *expected));
  if (!c.calibrated) return;
  const bool is_fitted = rows.eval(*c.calibrated, row).value_or(0) != 0;
  point.kind = is_fitted ? Kind::calibrated : Kind::predicted;
}

void add_bounded_point(CheckResult& result, const CheckPlan::Comparison& c, const Rows& rows,
                       std::size_t row, std::vector<std::size_t>& left_out) {
  const auto simulated = find_simulated(c, rows, row);
  const auto low = c.at_least ? rows.eval(*c.at_least, row) : std::nullopt;
  const auto high = c.at_most ? rows.eval(*c.at_most, row) : std::nullopt;
  if (!simulated || (c.at_least && !low) || (c.at_most && !high)) return left_out.push_back(row);
  result.points.push_back(compare_bounds(row, *simulated, low, high));
}

// Compares each reference value with its row, if the check applies to that row.
void compare_reference(CheckResult& result, const CheckPlan::Comparison& c, const Rows& rows,
                       const std::vector<std::size_t>& candidates,
                       std::vector<std::size_t>& left_out) {
  const Check& check = result.check;
  for (const auto& [row, expected] :
       match_reference({*c.reference, check.reference.path, check.column, check.keys}, rows.table(),
                       result.notes))
    if (std::ranges::binary_search(candidates, row))
      add_point(result, c, rows, row, expected, left_out);
}

// Summarises the points that were not used for calibration. No value without such points.
std::optional<Predicted> judge_predicted(const std::vector<CheckedPoint>& points) {
  Predicted predicted;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].kind == Kind::calibrated) continue;
    if (predicted.points++ == 0 ||
        size_of(points[i].error) > size_of(points[predicted.worst].error))
      predicted.worst = i;
    predicted.mean += size_of(points[i].error);
  }
  if (predicted.points == 0) return std::nullopt;
  predicted.mean /= static_cast<double>(predicted.points);
  return predicted;
}

// Judges a check. A check without points stays unmatched if some points of the sweep are missing
// (`is_whole` is false). Otherwise it fails unless it may be empty.
void judge(CheckResult& result, bool is_whole) {
  auto& points = result.points;
  if (points.empty()) {
    if (is_whole) result.verdict = result.check.may_be_empty ? Verdict::holds : Verdict::fails;
    return;
  }
  const auto rank = [&](const CheckedPoint& p) {
    return std::pair(!p.holds, badness(result.check, p));
  };
  result.worst = static_cast<std::size_t>(
      std::ranges::max_element(points, std::ranges::less(), rank) - points.begin());
  for (const auto& p : points) result.mean += size_of(p.error) / static_cast<double>(points.size());
  const bool holds = std::ranges::all_of(points, &CheckedPoint::holds) &&
                     result.mean <= result.check.within_mean.value_or(NO_LIMIT);
  result.verdict = holds ? Verdict::holds : Verdict::fails;
}

CheckResult eval_check(const CheckPlan::Comparison& c, const Rows& rows) {
  CheckResult result{.check = c.check};
  const auto candidates = choose_rows(rows, c.where);
  std::vector<std::size_t> left_out;
  if (c.reference) compare_reference(result, c, rows, candidates, left_out);
  for (const auto row : candidates) {
    if (c.formula) add_point(result, c, rows, row, rows.eval(*c.formula, row), left_out);
    if (c.check.has_bounds()) add_bounded_point(result, c, rows, row, left_out);
  }
  if (const auto note = note_left_out(rows.table(), left_out)) result.notes.push_back(*note);
  const auto is_complete = [&](const auto& row) { return is_complete_row(rows.table(), row); };
  judge(result, std::ranges::all_of(rows.table().rows, is_complete));
  if (c.calibrated) result.predicted = judge_predicted(result.points);
  return result;
}

std::string format_error(const Check& check, double error) {
  if (std::isnan(error)) return "not a number";
  if (std::isinf(error)) return "infinite";
  return check.is_absolute() ? fmt::format("{:.3g}", error) : fmt::format("{:.3g} %", 100 * error);
}

// Formats "at least 12", "at most 0.5" or "between 1 and 2".
std::string describe_bounds(const Check& check) {
  if (check.at_most.empty()) return "at least " + check.at_least;
  if (check.at_least.empty()) return "at most " + check.at_most;
  return fmt::format("between {} and {}", check.at_least, check.at_most);
}

double without_sign_of_nan(double value) { return std::isnan(value) ? NAN : value; }

// Formats "worst error 0.2 % (within 1 %)", or "worst 15.6 (at least 12)".
std::string describe_worst(const Check& check, const CheckedPoint& worst) {
  const double simulated = without_sign_of_nan(worst.simulated);
  if (check.has_bounds())
    return fmt::format("worst {:.5g} ({})", simulated, describe_bounds(check));
  std::string text = "worst error " + format_error(check, std::abs(worst.error));
  if (!std::isfinite(worst.error))
    text +=
        fmt::format(" (simulated {}, expected {})", simulated, without_sign_of_nan(worst.expected));
  if (const auto limit = check.is_absolute() ? check.within_abs : check.within)
    text += fmt::format(" (within {})", format_error(check, *limit));
  return text;
}

// Chooses the points to show: all in order, or the worst first.
std::vector<std::size_t> choose_points(const CheckResult& result, std::size_t most) {
  std::vector<std::size_t> order(result.points.size());
  std::iota(order.begin(), order.end(), 0);
  if (order.size() <= most) return order;
  std::ranges::stable_sort(order, std::greater(),
                           [&](auto i) { return badness(result.check, result.points[i]); });
  order.resize(std::min(WORST_SHOWN, order.size()));
  return order;
}

// The column name of the expected values.
std::string name_expected(const Check& check) {
  if (!check.formula.empty()) return "formula";
  if (!check.reference.path.empty()) return "reference";
  return check.at_most.empty() ? "at least" : check.at_least.empty() ? "at most" : "bound";
}

}  // namespace

std::vector<CheckResult> eval_checks(const CheckPlan& plan, const ExperimentFile& file,
                                     const Table& table) {
  if (plan.comparisons.empty()) return {};
  base::check_equal("points of the results", table.count_points(), file.points.size());
  std::vector<CheckResult> results;
  const auto complete = [&](const auto& row) { return is_complete_row(table, row); };
  const auto first =
      static_cast<std::size_t>(std::ranges::find_if(table.rows, complete) - table.rows.begin());
  if (first == table.rows.size()) {  // no point of the sweep was completed
    for (const auto& comparison : plan.comparisons) results.push_back({.check = comparison.check});
    return results;
  }
  const Rows rows = make_rows(plan, file, table);
  check_names(plan, rows, first);
  for (const auto& comparison : plan.comparisons) results.push_back(eval_check(comparison, rows));
  return results;
}

std::string summarize(const CheckResult& result, const Table& table) {
  const Check& check = result.check;
  if (result.verdict == Verdict::unmatched)
    return fmt::format("no point {}: {} at no point of these incomplete results", check.name,
                       check.of);
  const auto* verdict = result.verdict == Verdict::holds ? "ok" : "FAILED";
  if (result.points.empty())
    return fmt::format("{:<8} {}: {} at no point{}", verdict, check.name, check.of,
                       check.may_be_empty ? "" : ", expected at least one, or may_be_empty = true");
  const auto& worst = result.points[result.worst];
  std::string line = fmt::format("{:<8} {}: {} at {} point(s), {}", verdict, check.name, check.of,
                                 result.points.size(), describe_worst(check, worst));
  if (table.axes > 0 && (worst.error != 0 || check.has_bounds()))
    line += " at " + name_axes(table, worst.row);
  if (check.within_mean)
    line += fmt::format("; mean {} (within {})", format_error(check, result.mean),
                        format_error(check, *check.within_mean));
  if (const auto& p = result.predicted)
    line += fmt::format("; of the {} predicted alone: mean {}, worst {}", p->points,
                        format_error(check, p->mean),
                        format_error(check, std::abs(result.points[p->worst].error)));
  if (const auto& covered = result.covered) {
    line +=
        fmt::format("; {} of {} where nine of ten machines are", covered->inside, covered->points);
    if (check.covers) line += fmt::format(" (at least {:g} %)", 100 * *check.covers);
    if (const auto& own = covered->with_own_error)
      line += fmt::format(", {} with the model's own error ({:+.2g} ± {:.2g} %)", own->inside,
                          100 * own->mean, 100 * own->half_width);
  }
  return line;
}

Table make_check_table(const CheckResult& result, const Table& table, std::size_t most) {
  const Check& check = result.check;
  Table shown{.columns = axis_names(table), .axes = table.axes, .rows = {}};
  const bool has_kinds = !check.calibrated.empty() || name_expected(check) == "bound";
  shown.columns.insert(shown.columns.end(), {"simulated", name_expected(check),
                                             check.is_absolute() ? "error" : "error %"});
  if (has_kinds) shown.columns.emplace_back("kind");
  shown.columns.emplace_back("mark");
  for (const std::size_t i : choose_points(result, most)) {
    const auto& p = result.points[i];
    auto& row = shown.rows.emplace_back(table.rows[p.row]);
    row.resize(table.axes);
    std::string mark = p.holds ? "" : "fails";
    if (i == result.worst && (p.error != 0 || check.has_bounds()))
      mark += mark.empty() ? "worst" : ", worst";
    row.emplace_back(fmt::format("{:.5g}", without_sign_of_nan(p.simulated)));
    row.emplace_back(fmt::format("{:.5g}", without_sign_of_nan(p.expected)));
    row.emplace_back(without_sign_of_nan(check.is_absolute() ? p.error : 100 * p.error));
    if (has_kinds) row.emplace_back(KIND_NAMES[static_cast<int>(p.kind)]);
    row.emplace_back(mark);
  }
  return shown;
}

Table make_checks_csv(const std::vector<CheckResult>& results, const Table& table) {
  Table csv{.columns = axis_names(table), .axes = table.axes + 1, .rows = {}};
  csv.columns.insert(csv.columns.begin(), "check");
  csv.columns.insert(csv.columns.end(), {"simulated", "expected", "error", "kind"});
  for (const auto& result : results)
    for (const auto& p : result.points) {
      auto& row = csv.rows.emplace_back(table.rows[p.row]);
      row.resize(table.axes);
      row.insert(row.begin(), result.check.name);
      for (const double value : {p.simulated, p.expected, p.error})
        row.emplace_back(without_sign_of_nan(value));
      row.emplace_back(p.kind == Kind::unknown ? Value() : KIND_NAMES[static_cast<int>(p.kind)]);
    }
  return csv;
}

}  // namespace laboratory
