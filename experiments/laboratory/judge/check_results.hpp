#pragma once
// Compares results with formulas, references and bounds, and describes the outcome for people.
#include <string>
#include <vector>

#include "experiments/laboratory/judge/check_plan.hpp"
#include "experiments/laboratory/table/table.hpp"
#include "experiments/laboratory/uncertain/confidence.hpp"

namespace laboratory {

/// The kind of a point's `expected` value: a prediction, a value that the machine was fitted to, or
/// a bound.
enum class Kind { unknown, predicted, calibrated, at_least, at_most };

/// One point of a check.
struct CheckedPoint {
  std::size_t row = 0;                 ///< index into the table of results
  double simulated = 0, expected = 0;  ///< of two bounds the broken or else nearer one
  double error = 0;  ///< relative to `expected`, or absolute; for a bound the excess, 0 if there is
                     ///< none; not a number if either value is none
  bool holds = false;  ///< for this point alone; the mean is judged over all
  Kind kind = Kind::unknown;
};

/// The points of a check that were not used for calibration.
struct Predicted {
  std::size_t points = 0;
  std::size_t worst = 0;  ///< index into the check's points
  double mean = 0;
};

enum class Verdict { holds, fails, unmatched };  ///< unmatched: the check applies to no point

struct CheckResult {
  Check check;
  Verdict verdict = Verdict::unmatched;
  std::vector<CheckedPoint> points = {};
  std::size_t worst = 0;                    ///< index into `points`
  double mean = 0;                          ///< mean of the absolute errors
  std::optional<Predicted> predicted = {};  ///< if the check distinguishes calibrated points
  /// Coverage by intervals that include the model's own error (cover.hpp): the number of points
  /// inside, and the intervals' shift and half width, medians over the points relative to simulated
  /// values.
  struct WithOwnError {
    std::size_t inside = 0;
    double mean = 0, half_width = 0;
  };
  /// With drawn machines: points with intervals, and those whose expected value is inside.
  struct Covered {
    std::size_t inside = 0, points = 0;
    std::optional<WithOwnError> with_own_error = {};
  };
  std::optional<Covered> covered = {};
  std::vector<std::string> notes = {};
};

/// Evaluates all checks of a plan; the table has all points. Throws as check_names does.
std::vector<CheckResult> eval_checks(const CheckPlan& plan, const ExperimentFile& file,
                                     const Table& table);

/// "ok      NAME: latency_s at 7 points, worst error 0.2 % (within 1 %) at bytes = 1"
std::string summarize(const CheckResult& result, const Table& table);

/// A row for each point: axes, simulated and expected value, error, kind (if there are several),
/// and a mark for the worst point and for failures. With more than `most` points, only the ten
/// worst.
Table make_check_table(const CheckResult& result, const Table& table, std::size_t most);

/// checks.csv, a row for each check and point: the check, the axes, simulated, expected, error and
/// kind as in CheckedPoint (calibrated, predicted, at_least, at_most or empty).
Table make_checks_csv(const std::vector<CheckResult>& results, const Table& table);

}  // namespace laboratory
