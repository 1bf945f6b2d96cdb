#pragma once
// Comparison of two or more runs, as text for a terminal and as a page.
#include <string>
#include <vector>

#include "experiments/laboratory/compare/ratios.hpp"
#include "experiments/laboratory/compare/runs.hpp"

namespace laboratory {

/// Runs that are compared at their common points. The first is the reference.
struct Comparison {
  std::vector<ComparedRun> runs;
  MatchedRuns matched;
  std::vector<std::string> columns;  ///< results to compare, at least one
};

/// Compares runs. `columns` names the results to compare; if empty, they are those of the first
/// run's default table. Throws as load_runs and match_points do. Throws BadInput for a column that
/// is a setting in some run, or not numeric in all runs.
Comparison compare_runs(const std::vector<std::string>& folders,
                        const std::vector<std::string>& columns);

/// Formats the comparison for a terminal: differing settings and model entries, one sentence for
/// each result, and a table of the first differing result.
std::string to_text(const Comparison& comparison);

/// Formats the comparison as an HTML page in the layout of reports. The page names the plots that
/// could not be drawn, which are also added to `undrawn`.
std::string to_page(const Comparison& comparison, std::vector<std::string>& undrawn);

}  // namespace laboratory
