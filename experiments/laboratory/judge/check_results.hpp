#pragma once
// Results compared with formulas and references, and the outcome for people.
#include <string>
#include <vector>

#include "experiments/laboratory/judge/check_plan.hpp"
#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

// One point of a check.
struct CheckedPoint {
  std::size_t row = 0;  // of the table of results
  double simulated = 0, expected = 0;
  double error = 0;    // relative to what was expected, or absolute; not a number where one of both
                       // is none
  bool holds = false;  // by itself; the mean is judged over all
  bool is_calibrated = false;  // the machine was fitted to this very number
};

// The points of a check that nothing was calibrated on.
struct Predicted {
  std::size_t points = 0;
  std::size_t worst = 0;  // of the check's points
  double mean = 0;
};

enum class Verdict { holds, fails, unmatched };  // unmatched: it speaks of no point

struct CheckResult {
  Check check;
  Verdict verdict = Verdict::unmatched;
  std::vector<CheckedPoint> points;
  std::size_t worst = 0;               // of `points`
  double mean = 0;                     // of the errors' sizes
  std::optional<Predicted> predicted;  // where the check says which points are calibrated
  std::vector<std::string> notes;
};

// Of the table of all points. Throws as check_names does.
std::vector<CheckResult> eval_checks(const CheckPlan& plan, const ExperimentFile& file,
                                     const Table& table);

// "ok      NAME: latency_s at 7 points, worst error 0.2 % (within 1 %) at bytes = 1"
std::string summarize(const CheckResult& result, const Table& table);

// A row per point: axes, simulated, expected, error, "calibrated" or "predicted" where the check
// tells them apart, and a mark for the worst and those that fail.
// Of more than `most` points only the ten worst.
Table make_check_table(const CheckResult& result, const Table& table, std::size_t most);

// checks.csv: a row per check and point.
Table make_checks_csv(const std::vector<CheckResult>& results, const Table& table);

}  // namespace laboratory
