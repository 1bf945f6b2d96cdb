#pragma once
// Evaluation of [[best]]: the best values of some axes for each combination of others, and how far
// doubling an axis pays.
#include <string>
#include <vector>

#include "experiments/laboratory/judge/check_plan.hpp"

namespace laboratory {

/// The answer to one [[best]]. Tables without rows are not shown.
struct BestAnswer {
  std::string name;
  /// A table with one row for each combination of values of `for_each`. Its columns are the
  /// combination, the best value of `over` and its result, the runner-up and its result, and the
  /// lead in %. Values whose results are within 0.05 % of the best share its cell, "mesh or torus".
  Table best;
  /// A table with one row for each combination of all axes except `pays`. It has the largest value
  /// of `pays` up to which each step gains at least the required share per doubling. The next
  /// column has the gain per doubling, in %, of the step after this value. It is empty if there is
  /// none.
  Table pays;
  std::vector<std::string> notes;
  std::vector<std::string> findings;  ///< one sentence for each finding
};

std::vector<BestAnswer> find_best(const CheckPlan& plan, const Rows& rows);

/// Makes best.csv and pays.csv: the rows of all answers. Each row begins with the question's name
/// and the text of its combination.
Table make_best_csv(const std::vector<BestAnswer>& answers);
Table make_pays_csv(const std::vector<BestAnswer>& answers);

}  // namespace laboratory
