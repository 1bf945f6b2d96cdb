// The figures that an experiment declares: [[plot]] over its results, with tables and findings.
#pragma once

#include <string>
#include <vector>

#include "experiments/laboratory/judge/check_plan.hpp"
#include "experiments/laboratory/report/plot.hpp"

namespace laboratory {

/// A figure and the tables below it; tables without rows are not shown.
struct Exhibit {
  Plot plot;
  Table differences = {};  ///< for each point with a reference: predicted, reference, difference %
  Table fits = {};         ///< for each curve and parameter: value and 95 % confidence interval
  Table optima = {};       ///< for each curve: its largest y and the next point
  std::vector<std::string> notes = {};     ///< points left out, laws that were not fitted
  std::vector<std::string> findings = {};  ///< sentences
};

/// Makes the figures that have points, in the order of the file. Adds a note to `nothing` for each
/// figure without points.
std::vector<Exhibit> make_exhibits(const CheckPlan& plan, const Rows& rows,
                                   std::vector<std::string>& nothing);

/// fits.csv: the rows of all fits, with the plot's name first.
Table make_fits_csv(const std::vector<Exhibit>& exhibits);

}  // namespace laboratory
