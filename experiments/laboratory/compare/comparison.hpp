#pragma once
// Comparison of two or more runs, as text for a terminal and as an HTML page.
#include <filesystem>
#include <string>
#include <vector>

#include "base/figure/figure_style.hpp"
#include "experiments/laboratory/compare/ratios.hpp"
#include "experiments/laboratory/compare/runs.hpp"

namespace laboratory {

/// Runs that are compared at the points of the sweep that all of them have. The first run is the
/// reference.
struct Comparison {
  std::vector<ComparedRun> runs;
  MatchedRuns matched;
  std::vector<std::string> columns;  ///< results to compare, at least one
};

/// Compares the runs in the given results folders. `columns` names the results to compare; if
/// empty, these are the results that are shown by default for the first run. Throws as load_runs()
/// and match_points() do. Throws BadInput for a column that is a setting in some run, or not
/// numeric in all runs.
Comparison compare_runs(const std::vector<std::string>& folders,
                        const std::vector<std::string>& columns);

/// Formats the comparison for a terminal: the settings and model entries that differ, sentences on
/// the results, and a table of the first result that differs.
std::string to_text(const Comparison& comparison);

/// Figures of the plots for papers: their style, and the existing folder for their files.
struct PaperFigures {
  base::FigureStyle style = {};
  std::filesystem::path folder = {};
};

/// Formats the comparison as an HTML page in the layout of reports, and writes the figures unless
/// their style has no width. The page names the plots that could not be drawn, which are also
/// appended to `undrawn`.
std::string to_page(const Comparison& comparison, const PaperFigures& figures,
                    std::vector<std::string>& undrawn);

}  // namespace laboratory
