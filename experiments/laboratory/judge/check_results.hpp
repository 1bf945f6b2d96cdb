#pragma once
// Compares results with formulas, reference tables and bounds, and describes the outcome.
#include <string>
#include <vector>

#include "experiments/laboratory/judge/check_plan.hpp"
#include "experiments/laboratory/table/table.hpp"
#include "experiments/laboratory/uncertain/confidence.hpp"

namespace laboratory {

/// Origin of a point's `expected` value: it was not used to calibrate the machine model
/// (predicted), was used (calibrated), or is a bound.
enum class Kind { unknown, predicted, calibrated, at_least, at_most };

/// The comparison at one point of a check.
struct CheckedPoint {
  std::size_t row = 0;  ///< row number in the table of results
  /// if there are two bounds, `expected` is the violated one, or else the nearer one
  double simulated = 0, expected = 0;
  /// Error relative to `expected`, or absolute in the column's unit. For a bound, it is the excess
  /// beyond the bound, and 0 within the bounds. NaN if either value is NaN.
  double error = 0;
  /// true if the error is within the limit for single points; the limit on the mean is separate
  bool holds = false;
  Kind kind = Kind::unknown;
  /// Number of seeds averaged. With several seeds, `row` is the row of the first seed, the values
  /// are means over the seeds, and the error is that of the means.
  std::size_t seeds = 1;
  /// Half width of the 95 % confidence interval of `error`, in the same unit; for a bound, of the
  /// simulated value. No value for a single seed.
  std::optional<double> half_width = {};
};

/// Summary of the errors at points that were not used for calibration.
struct Predicted {
  std::size_t points = 0;
  std::size_t worst = 0;  ///< index of the worst point in the check's points
  double mean = 0;
};

/// `unmatched`: the check covers no completed point, but the sweep is incomplete. In a complete
/// sweep, such a check fails, unless it may be empty.
enum class Verdict { holds, fails, unmatched };

struct CheckResult {
  Check check;
  Verdict verdict = Verdict::unmatched;
  std::vector<CheckedPoint> points = {};
  std::size_t worst = 0;  ///< index of the worst point in `points`
  double mean = 0;        ///< mean of the absolute errors
  /// no value if the check does not distinguish calibrated points
  std::optional<Predicted> predicted = {};
  /// Result if the intervals include the model's own error (see cover.hpp): the number of expected
  /// values inside their intervals. Also the medians, over the points, of the intervals' shift and
  /// of their half width, as fractions of the simulated values.
  struct WithOwnError {
    std::size_t inside = 0;
    double mean = 0, half_width = 0;
  };
  /// Result for intervals over randomly drawn machines: the number of points with an interval, and
  /// the number of these whose expected value is inside.
  struct Covered {
    std::size_t inside = 0, points = 0;
    std::optional<WithOwnError> with_own_error = {};
  };
  std::optional<Covered> covered = {};
  std::vector<std::string> notes = {};
};

/// Evaluates all checks of a plan on the table of all points. Throws as check_names() does.
std::vector<CheckResult> eval_checks(const CheckPlan& plan, const ExperimentFile& file,
                                     const Table& table);

/// Formats a result in one line: "ok NAME: latency_s at 7 points, worst error 0.2 % (within 1 %) at
/// bytes = 1".
std::string summarize(const CheckResult& result, const Table& table);

/// Makes a table with one row for each point: axes, simulated and expected value, error, kind (if
/// the points are of several kinds), and a mark for failures and for the worst point. If there are
/// more than `most` points, the table has only the ten worst.
Table make_check_table(const CheckResult& result, const Table& table, std::size_t most);

/// Makes checks.csv, with one row for each check and point: name of the check, axes, then
/// simulated, expected, error and kind as in CheckedPoint. The kind is "calibrated", "predicted",
/// "at_least", "at_most" or empty.
Table make_checks_csv(const std::vector<CheckResult>& results, const Table& table);

}  // namespace laboratory
