#pragma once
// Two or more runs side by side, as text for a terminal and as a page.
#include <string>
#include <vector>

#include "experiments/laboratory/compare/ratios.hpp"
#include "experiments/laboratory/compare/runs.hpp"

namespace laboratory {

/// Runs over the same points; the first is the reference.
struct Comparison {
  std::vector<ComparedRun> runs;
  MatchedRuns matched;
  std::vector<std::string> columns;  ///< the results to compare, at least one
};

/// `columns`: the results to compare; empty: those of the first run's default table. Throws as
/// load_runs and match_points do, and BadInput for a column that is a setting in some run or not
/// numeric in all runs.
Comparison compare_runs(const std::vector<std::string>& folders,
                        const std::vector<std::string>& columns);

/// Text for a terminal: differing settings and model entries, a sentence on each result, and the
/// first differing result at each point.
std::string to_text(const Comparison& comparison);

/// The HTML page, in the layout of reports. It names plots that fail and adds them to `undrawn`.
std::string to_page(const Comparison& comparison, std::vector<std::string>& undrawn);

}  // namespace laboratory
