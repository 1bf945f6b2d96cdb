#pragma once
// Comparison of results with formulas, references and bounds, and description of the outcome.
#include <string>
#include <vector>

#include "experiments/laboratory/judge/check_plan.hpp"
#include "experiments/laboratory/table/table.hpp"
#include "experiments/laboratory/uncertain/confidence.hpp"

namespace laboratory {

/// How the model is related to the `expected` value of a point: the value was not used for
/// calibration (predicted), was used for it (calibrated), or is a bound.
enum class Kind { unknown, predicted, calibrated, at_least, at_most };

/// One point of a check.
struct CheckedPoint {
  std::size_t row = 0;  ///< row number in the table of results
  /// for two bounds, `expected` is the violated or else the nearer one
  double simulated = 0, expected = 0;
  /// Error relative to `expected`, or absolute in the column's unit. For a bound it is the excess,
  /// 0 within bounds. NaN if either value is NaN.
  double error = 0;
  /// true if the error is within the limit for a single point; the limit on the mean is separate
  bool holds = false;
  Kind kind = Kind::unknown;
  /// Number of seeds. With several, `row` is that of the first, the values are means over the
  /// seeds, and the error is that of the means.
  std::size_t seeds = 1;
  /// Half width of the 95 % confidence interval of the error, in its unit; for a bound, of the
  /// simulated value. None for a single seed.
  std::optional<double> half_width = {};
};

/// Summary of the points that were not used for calibration.
struct Predicted {
  std::size_t points = 0;
  std::size_t worst = 0;  ///< index of the worst point in the check's points
  double mean = 0;
};

/// unmatched: the check applies to no completed point, and some points are incomplete. If all are
/// complete, such a check fails unless it may be empty.
enum class Verdict { holds, fails, unmatched };

struct CheckResult {
  Check check;
  Verdict verdict = Verdict::unmatched;
  std::vector<CheckedPoint> points = {};
  std::size_t worst = 0;  ///< index of the worst point in `points`
  double mean = 0;        ///< mean of the absolute errors
  /// present only if the check distinguishes calibrated points
  std::optional<Predicted> predicted = {};
  /// Coverage by intervals that include the model's own error (cover.hpp): the number of points
  /// inside, then shift and half width of the intervals. Shift and half width are medians over the
  /// points, relative to the simulated values.
  struct WithOwnError {
    std::size_t inside = 0;
    double mean = 0, half_width = 0;
  };
  /// Coverage by randomly drawn machines: the number of points with intervals, and the number of
  /// these points whose expected value lies inside its interval.
  struct Covered {
    std::size_t inside = 0, points = 0;
    std::optional<WithOwnError> with_own_error = {};
  };
  std::optional<Covered> covered = {};
  std::vector<std::string> notes = {};
};

/// Evaluates all checks of a plan on the table of all points. Throws as check_names does.
std::vector<CheckResult> eval_checks(const CheckPlan& plan, const ExperimentFile& file,
                                     const Table& table);

/// Formats a result in one line: "ok NAME: latency_s at 7 points, worst error 0.2 % (within 1 %) at
/// bytes = 1".
std::string summarize(const CheckResult& result, const Table& table);

/// Makes a table with one row for each point: axes, simulated and expected value, error, kind (if
/// there are several), and a mark for failures and the worst point. If there are more than `most`
/// points, it has only the ten worst.
Table make_check_table(const CheckResult& result, const Table& table, std::size_t most);

/// Makes checks.csv, with one row for each check and point: name of the check, axes, then
/// simulated, expected, error and kind as in CheckedPoint. The kind is calibrated, predicted,
/// at_least, at_most or empty.
Table make_checks_csv(const std::vector<CheckResult>& results, const Table& table);

}  // namespace laboratory
