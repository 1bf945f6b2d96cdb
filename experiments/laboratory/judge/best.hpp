#pragma once
// Which value of some axes is best for each value of others, and how far more of one pays:
// [[best]].
#include <string>
#include <vector>

#include "experiments/laboratory/judge/check_plan.hpp"

namespace laboratory {

/// The answers to one question; tables without rows are not shown.
struct BestAnswer {
  std::string name;
  /// A row for each combination of values of for_each: these, the best of `over`, its value, the
  /// runner-up, its value, and by what share in % the best is better. Those less than 0.05 % behind
  /// the best are best too: "mesh or torus".
  Table best;
  /// A row for each combination of all axes but `pays`: these, up to where it pays (the largest
  /// value such that every step until there gained the share per doubling), and what the step after
  /// it gains per doubling in %; empty where there is none.
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
