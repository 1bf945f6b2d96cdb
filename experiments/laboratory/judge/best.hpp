#pragma once
// [[best]]: the best value of some axes for each value of others, and the range in which doubling
// an axis pays.
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
  /// A row for each combination of all axes except `pays`: these, the largest value of `pays` up to
  /// which every step gained the share per doubling, and the gain per doubling of the next step in
  /// %; empty if there is none.
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
