#pragma once
// [[best]]: the best value of some axes for each value of others, and how far doubling an axis
// pays.
#include <string>
#include <vector>

#include "experiments/laboratory/judge/check_plan.hpp"

namespace laboratory {

/// The answers to one question; tables without rows are not shown.
struct BestAnswer {
  std::string name;
  /// A row for each combination of values of for_each: these, the best of `over`, its value, the
  /// runner-up, its value, and the lead in %. Values within 0.05 % of the best are best too: "mesh
  /// or torus".
  Table best;
  /// A row for each combination of all axes except `pays`: these, the largest value of `pays`
  /// before the first step without the share per doubling, and that step's gain per doubling in %.
  /// The gain is empty if there is no such step.
  Table pays;
  std::vector<std::string> notes;
  std::vector<std::string> findings;  ///< a sentence each
};

std::vector<BestAnswer> find_best(const CheckPlan& plan, const Rows& rows);

/// best.csv and pays.csv: the rows of all questions, with the question's name first and then the
/// combination as one text.
Table make_best_csv(const std::vector<BestAnswer>& answers);
Table make_pays_csv(const std::vector<BestAnswer>& answers);

}  // namespace laboratory
