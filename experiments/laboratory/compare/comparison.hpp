#pragma once
// Two runs or more side by side, for a terminal and as a page.
#include <string>
#include <vector>

#include "experiments/laboratory/compare/ratios.hpp"
#include "experiments/laboratory/compare/runs.hpp"

namespace laboratory {

/// Runs over the same points; the others are compared with the first.
struct Comparison {
  std::vector<ComparedRun> runs;
  MatchedRuns matched;
  std::vector<std::string> columns;  ///< the results to compare, at least one
};

/// `columns`: the results to compare; none: those of the first run's usual table. Throws what
/// load_runs and match_points throw, and BadInput for a column that is a setting of some run, or no
/// number in all runs.
Comparison compare_runs(const std::vector<std::string>& folders,
                        const std::vector<std::string>& columns);

/// For a terminal: the settings and entries of models that differ, a sentence on each result, and
/// the first result that differs at each point.
std::string to_text(const Comparison& comparison);

/// The page, in the layout of reports. Plots that fail are named in it and added to `undrawn`.
std::string to_page(const Comparison& comparison, std::vector<std::string>& undrawn);

}  // namespace laboratory
