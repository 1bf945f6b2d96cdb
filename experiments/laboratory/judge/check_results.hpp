#pragma once
// Results compared with formulas, references and bounds, and the outcome for people.
#include <string>
#include <vector>

#include "experiments/laboratory/judge/check_plan.hpp"
#include "experiments/laboratory/table/table.hpp"
#include "experiments/laboratory/uncertain/sureness.hpp"

namespace laboratory {

/// What `expected` of a point is: a prediction, a number that the machine was fitted to, or a
/// bound.
enum class Kind { unknown, predicted, calibrated, at_least, at_most };

/// One point of a check.
struct CheckedPoint {
  std::size_t row = 0;                 ///< of the table of results
  double simulated = 0, expected = 0;  ///< for two bounds the one that is broken, or else nearer
  double error = 0;    ///< relative to what was expected, or absolute; for a bound how far
                       ///< `simulated` is beyond it, 0 where it is not; not a number where
                       ///< one of both is none
  bool holds = false;  ///< by itself; the mean is judged over all
  Kind kind = Kind::unknown;
};

/// The points of a check that nothing was calibrated on.
struct Predicted {
  std::size_t points = 0;
  std::size_t worst = 0;  ///< index into the check's points
  double mean = 0;
};

enum class Verdict { holds, fails, unmatched };  ///< unmatched: it speaks of no point

struct CheckResult {
  Check check;
  Verdict verdict = Verdict::unmatched;
  std::vector<CheckedPoint> points = {};
  std::size_t worst = 0;                    ///< index into `points`
  double mean = 0;                          ///< mean of the errors' sizes
  std::optional<Predicted> predicted = {};  ///< where the check says which points are calibrated
  /// How many of them lie in intervals that have the model's own error too (cover.hpp); and, as
  /// shares of what is simulated, how far these intervals are moved and how wide they are, each the
  /// median of the points.
  struct WithOwnError {
    std::size_t inside = 0;
    double mean = 0, half_width = 0;
  };
  /// Where machines were drawn: of so many points with intervals so many are in theirs.
  struct Covered {
    std::size_t inside = 0, points = 0;
    std::optional<WithOwnError> with_own_error = {};
  };
  std::optional<Covered> covered = {};
  std::vector<std::string> notes = {};
};

/// The results of all checks of a plan; the table has all points. Throws as check_names does.
std::vector<CheckResult> eval_checks(const CheckPlan& plan, const ExperimentFile& file,
                                     const Table& table);

/// "ok      NAME: latency_s at 7 points, worst error 0.2 % (within 1 %) at bytes = 1"
std::string summarize(const CheckResult& result, const Table& table);

/// A row for each point: axes, simulated, what was expected, error, kind where the points have
/// several, and a mark for the worst and for those that fail. Of more than `most` points only the
/// ten worst.
Table make_check_table(const CheckResult& result, const Table& table, std::size_t most);

/// checks.csv, a row for each check and point: the check, the axes, simulated, expected, error and
/// kind, as in CheckedPoint; kind is calibrated, predicted, at_least, at_most or empty.
Table make_checks_csv(const std::vector<CheckResult>& results, const Table& table);

}  // namespace laboratory
