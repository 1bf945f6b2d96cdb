#include "experiments/laboratory/judge/check_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "experiments/laboratory/points/results.hpp"
#include "experiments/laboratory/table/samples.hpp"
#include "experiments/laboratory/table/statistics.hpp"

namespace laboratory {
namespace {

constexpr double NO_VALUE = std::numeric_limits<double>::quiet_NaN();
constexpr double NO_LIMIT = 1e300;
constexpr std::size_t WORST_SHOWN = 10;
constexpr const char* KIND_NAMES[] = {"", "predicted", "calibrated", "at_least", "at_most"};

// The absolute value of an error. NaN counts as infinite.
double size_of(double error) { return std::isnan(error) ? INFINITY : std::abs(error); }

// The sort key that is largest for the worst point: the error, or for a point within its bounds the
// negative distance to the nearer bound.
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

// Compares a value with a lower bound, an upper bound or both.
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

// The checked value in a row; no value if its cell is empty, as for a speed-up without a run on one
// worker.
std::optional<double> find_simulated(const CheckPlan::Comparison& c, const Rows& rows,
                                     std::size_t row) {
  if (c.of) return rows.eval(*c.of, row);
  const Table& table = rows.table();
  return as_number(table.rows[row][*table.find(c.check.of)]);
}

// The simulated value of a row, and the expected value or the bounds to compare it with.
struct Compared {
  std::size_t row = 0;
  double simulated = 0;
  std::optional<double> expected = {}, low = {}, high = {};
  Kind kind = Kind::unknown;
};

// The rows that a check compares, and the rows that it leaves out because a value is missing.
struct ComparedRows {
  std::vector<Compared> all;
  std::vector<std::size_t> left_out;
};

// Adds a row if both the simulated and the expected value exist; otherwise counts it as left out.
void add_row(ComparedRows& compared, const CheckPlan::Comparison& c, const Rows& rows,
             std::size_t row, std::optional<double> expected) {
  const auto simulated = find_simulated(c, rows, row);
  if (!simulated || !expected) return compared.left_out.push_back(row);
  auto& added = compared.all.emplace_back(Compared{row, *simulated, expected});
  if (!c.calibrated) return;
  const bool is_fitted = rows.eval(*c.calibrated, row).value_or(0) != 0;
  added.kind = is_fitted ? Kind::calibrated : Kind::predicted;
}

void add_bounded_row(ComparedRows& compared, const CheckPlan::Comparison& c, const Rows& rows,
                     std::size_t row) {
  const auto simulated = find_simulated(c, rows, row);
  const auto low = c.at_least ? rows.eval(*c.at_least, row) : std::nullopt;
  const auto high = c.at_most ? rows.eval(*c.at_most, row) : std::nullopt;
  if (!simulated || (c.at_least && !low) || (c.at_most && !high))
    return compared.left_out.push_back(row);
  compared.all.push_back({row, *simulated, {}, low, high});
}

// Groups the rows that differ only in the seed. If a row occurs several times, each occurrence goes
// into a different group.
std::vector<std::vector<Compared>> group_rows(const std::vector<Compared>& all,
                                              const Table& table) {
  std::vector<std::vector<Compared>> groups;
  const bool has_seeds = !find_seeds(table).empty();
  const auto group_of = number_samples(table);
  for (const auto& it : all) {
    const auto fits = [&](const auto& group) {
      return group_of[group[0].row] == group_of[it.row] &&
             std::ranges::find(group, it.row, &Compared::row) == group.end();
    };
    const auto group = has_seeds ? std::ranges::find_if(groups, fits) : groups.end();
    if (group == groups.end())
      groups.push_back({it});
    else
      group->push_back(it);
  }
  return groups;
}

// Compares the mean simulated value of a group with its mean expected value or bounds. The
// confidence interval is that of the differences between simulated and expected values, because a
// seed may affect both.
CheckedPoint compare_means(const Check& check, const std::vector<Compared>& group) {
  const auto mean_of = [&](auto get) {
    std::vector<double> values;
    for (const auto& it : group) values.push_back(get(it));
    return values;
  };
  const auto mean_if = [&](std::optional<double> Compared::*bound) -> std::optional<double> {
    if (!(group[0].*bound)) return std::nullopt;
    return find_mean(mean_of([&](const Compared& it) { return *(it.*bound); }));
  };
  const auto simulated = mean_of([](const Compared& it) { return it.simulated; });
  const auto expected = mean_if(&Compared::expected);
  auto point = expected ? compare(check, group[0].row, find_mean(simulated), *expected)
                        : compare_bounds(group[0].row, find_mean(simulated),
                                         mean_if(&Compared::low), mean_if(&Compared::high));
  if (expected) point.kind = group[0].kind;
  point.seeds = group.size();
  if (group.size() < 2) return point;
  const auto differences =
      mean_of([](const Compared& it) { return it.simulated - it.expected.value_or(0); });
  const auto half = find_mean_interval(differences).half_width;
  if (!half || !std::isfinite(*half)) return point;
  point.half_width =
      expected && !check.is_absolute() && *expected != 0 ? *half / std::abs(*expected) : *half;
  return point;
}

// Compares each reference value with the row that it belongs to. Skips rows that the check does not
// cover.
void compare_reference(CheckResult& result, const CheckPlan::Comparison& c, const Rows& rows,
                       const std::vector<std::size_t>& candidates, ComparedRows& compared) {
  const Check& check = result.check;
  for (const auto& [row, expected] :
       match_reference({*c.reference, check.reference.path, check.column, check.keys}, rows.table(),
                       result.notes))
    if (std::ranges::binary_search(candidates, row)) add_row(compared, c, rows, row, expected);
}

// Summarises the errors of points that were not used for calibration. No value if there are none.
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

// Decides whether a check holds. A check that covers no point is `unmatched` if the sweep is
// incomplete (`is_whole` is false). In a complete sweep it fails, unless the check may be empty.
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
  ComparedRows compared;
  if (c.reference) compare_reference(result, c, rows, candidates, compared);
  for (const auto row : candidates) {
    if (c.formula) add_row(compared, c, rows, row, rows.eval(*c.formula, row));
    if (c.check.has_bounds()) add_bounded_row(compared, c, rows, row);
  }
  for (const auto& group : group_rows(compared.all, rows.table()))
    result.points.push_back(compare_means(c.check, group));
  if (const auto note = note_left_out(rows.table(), compared.left_out))
    result.notes.push_back(*note);
  const auto is_complete = [&](const auto& row) { return is_complete_row(rows.table(), row); };
  judge(result, std::ranges::all_of(rows.table().rows, is_complete));
  if (c.calibrated) result.predicted = judge_predicted(result.points);
  return result;
}

double without_sign_of_nan(double value) { return std::isnan(value) ? NAN : value; }

std::string format_error(const Check& check, double error) {
  if (std::isnan(error)) return "not a number";
  if (std::isinf(error)) return "infinite";
  return check.is_absolute() ? fmt::format("{:.3g}", error) : fmt::format("{:.3g} %", 100 * error);
}

// Formats a bound. An expression is preceded by its value, "0.5 = EXPRESSION", if it is the bound
// that the point was compared with.
std::string describe_bound(const std::string& text, const CheckedPoint& point, Kind kind) {
  if (base::parse_number<double>(text)) return text;
  if (point.kind != kind) return text;
  return fmt::format("{:.5g} = {}", without_sign_of_nan(point.expected), text);
}

// Formats "at least 12", "at most 0.5 = 2 * {time_s @ workers = 4}" or "between 1 and 2".
std::string describe_bounds(const Check& check, const CheckedPoint& point) {
  const auto low = describe_bound(check.at_least, point, Kind::at_least);
  const auto high = describe_bound(check.at_most, point, Kind::at_most);
  if (check.at_most.empty()) return "at least " + low;
  if (check.at_least.empty()) return "at most " + high;
  return fmt::format("between {} and {}", low, high);
}

// Formats "worst error 0.2 % (within 1 %)", or "worst 15.6 (at least 12)".
std::string describe_worst(const Check& check, const CheckedPoint& worst) {
  const double simulated = without_sign_of_nan(worst.simulated);
  if (check.has_bounds()) {
    const auto half = worst.half_width ? fmt::format(" ± {:.2g}", *worst.half_width) : "";
    return fmt::format("worst {:.5g}{} ({})", simulated, half, describe_bounds(check, worst));
  }
  std::string text = "worst error " + format_error(check, std::abs(worst.error));
  if (worst.half_width) text += " ± " + format_error(check, *worst.half_width);
  if (!std::isfinite(worst.error))
    text +=
        fmt::format(" (simulated {}, expected {})", simulated, without_sign_of_nan(worst.expected));
  if (const auto limit = check.is_absolute() ? check.within_abs : check.within)
    text += fmt::format(" (within {})", format_error(check, *limit));
  return text;
}

// Chooses the points to show: all of them in order, or only the worst if there are more than
// `most`.
std::vector<std::size_t> choose_points(const CheckResult& result, std::size_t most) {
  std::vector<std::size_t> order(result.points.size());
  std::iota(order.begin(), order.end(), 0);
  if (order.size() <= most) return order;
  std::ranges::stable_sort(order, std::greater(),
                           [&](auto i) { return badness(result.check, result.points[i]); });
  order.resize(std::min(WORST_SHOWN, order.size()));
  return order;
}

// The name of the column with the expected values.
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
    line += " at " + name_sampled_axes(table, worst.row);
  if (worst.seeds > 1) line += fmt::format(" (mean over {} seeds)", worst.seeds);
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
  Table shown{.columns = sampled_axis_names(table), .axes = 0, .rows = {}};
  shown.axes = shown.columns.size();
  const bool has_seeds = !find_seeds(table).empty();
  const bool has_kinds = !check.calibrated.empty() || name_expected(check) == "bound";
  shown.columns.insert(shown.columns.end(), {"simulated", name_expected(check),
                                             check.is_absolute() ? "error" : "error %"});
  if (has_seeds) shown.columns.insert(shown.columns.end(), {"±", "seeds"});
  if (has_kinds) shown.columns.emplace_back("kind");
  shown.columns.emplace_back("mark");
  for (const std::size_t i : choose_points(result, most)) {
    const auto& p = result.points[i];
    auto& row = shown.rows.emplace_back(take_sampled_axes(table, p.row));
    std::string mark = p.holds ? "" : "fails";
    if (i == result.worst && (p.error != 0 || check.has_bounds()))
      mark += mark.empty() ? "worst" : ", worst";
    row.emplace_back(fmt::format("{:.5g}", without_sign_of_nan(p.simulated)));
    row.emplace_back(fmt::format("{:.5g}", without_sign_of_nan(p.expected)));
    row.emplace_back(without_sign_of_nan(check.is_absolute() ? p.error : 100 * p.error));
    if (has_seeds) {
      auto& half = row.emplace_back();
      const bool is_percent = !check.is_absolute() && !check.has_bounds();
      if (p.half_width) half = *p.half_width * (is_percent ? 100 : 1);
      row.emplace_back(static_cast<std::int64_t>(p.seeds));
    }
    if (has_kinds) row.emplace_back(KIND_NAMES[static_cast<int>(p.kind)]);
    row.emplace_back(mark);
  }
  return shown;
}

Table make_checks_csv(const std::vector<CheckResult>& results, const Table& table) {
  Table csv{.columns = sampled_axis_names(table), .axes = 0, .rows = {}};
  csv.axes = csv.columns.size() + 1;
  csv.columns.insert(csv.columns.begin(), "check");
  csv.columns.insert(csv.columns.end(), {"simulated", "expected", "error", "kind"});
  const bool has_seeds = !find_seeds(table).empty();
  if (has_seeds) csv.columns.insert(csv.columns.end(), {"seeds", "half_width_95"});
  for (const auto& result : results)
    for (const auto& p : result.points) {
      auto& row = csv.rows.emplace_back(take_sampled_axes(table, p.row));
      row.insert(row.begin(), result.check.name);
      for (const double value : {p.simulated, p.expected, p.error})
        row.emplace_back(without_sign_of_nan(value));
      row.emplace_back(p.kind == Kind::unknown ? Value() : KIND_NAMES[static_cast<int>(p.kind)]);
      if (!has_seeds) continue;
      row.emplace_back(static_cast<std::int64_t>(p.seeds));
      auto& half = row.emplace_back();
      if (p.half_width) half = *p.half_width;
    }
  return csv;
}

}  // namespace laboratory
