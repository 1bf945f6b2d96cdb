#pragma once
// Answers to [[best]]: the best values of some axes for each combination of the other axes, and up
// to which value doubling an axis pays.
#include <string>
#include <vector>

#include "experiments/laboratory/judge/check_plan.hpp"

namespace laboratory {

/// The answer to one [[best]]. Tables without rows are not shown.
struct BestAnswer {
  std::string name;
  /// One row for each combination of values of `for_each`. The columns are these values, the best
  /// value of `over` and its result, the runner-up and its result, and by how many percent the best
  /// is better. Values count as equally good if their results differ by less than 0.05 %, or if the
  /// difference may be due to chance. Such values share a cell, "mesh or torus".
  Table best;
  /// One row for each combination of values of all axes except `pays`. The column after these
  /// values has the largest value of `pays` up to which each step gains at least the required share
  /// per doubling. The last column has the gain per doubling of the next step, in percent; it is
  /// empty if there is no next step.
  Table pays;
  std::vector<std::string> notes;
  std::vector<std::string> findings;  ///< one sentence for each finding
};

std::vector<BestAnswer> find_best(const CheckPlan& plan, const Rows& rows);

/// These functions make best.csv and pays.csv, with the rows of all answers. Each row begins with
/// the name of the [[best]] and the row's axis values as text.
Table make_best_csv(const std::vector<BestAnswer>& answers);
Table make_pays_csv(const std::vector<BestAnswer>& answers);

}  // namespace laboratory
