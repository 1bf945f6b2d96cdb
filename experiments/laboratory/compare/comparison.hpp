#pragma once
// Two runs or more side by side: for a terminal, as a table and as a page.
#include <string>
#include <vector>

#include "experiments/laboratory/compare/runs.hpp"

namespace laboratory {

/// What is compared: runs over the same points, the first of which the others are measured by.
struct Comparison {
  std::vector<ComparedRun> runs;
  Matched matched;
  std::vector<std::string> columns;  ///< results to compare, at least one
};

/// `columns`: what to compare; none: what the first run's program is usually asked for. Throws what
/// load_runs and match_points throw, and BadInput for runs without a point in common and for a
/// column that is no number in all of them.
Comparison compare_runs(const std::vector<std::string>& folders,
                        const std::vector<std::string>& columns);

/// What differs in settings and models, how much each result does, and the first one at each point.
std::string to_text(const Comparison& comparison);

/// compare.csv: a row for each result and point, as compare_column.
Table to_table(const Comparison& comparison);

/// The page, in the layout of reports. Plots that fail are named in it and in `undrawn`.
std::string to_page(const Comparison& comparison, std::vector<std::string>& undrawn);

}  // namespace laboratory
