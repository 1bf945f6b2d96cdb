// Plots that an experiment declares with [[plot]], with their tables and findings.
#pragma once

#include <string>
#include <vector>

#include "experiments/laboratory/judge/check_plan.hpp"
#include "experiments/laboratory/report/plot.hpp"

namespace laboratory {

/// A plot and the tables below it. Tables without rows are not shown.
struct Exhibit {
  Plot plot;
  Table differences = {};  ///< for each point with a reference: predicted, reference, difference %
  Table fits = {};         ///< for each curve and parameter: value and 95 % confidence interval
  Table optima = {};       ///< for each curve: its maximum, and the point after it
  /// notes on points left out and laws that could not be fitted
  std::vector<std::string> notes = {};
  std::vector<std::string> findings = {};  ///< one sentence for each finding
};

/// Makes the plots that have points, in the order of the file. Adds a note to `nothing` for each
/// plot without points.
std::vector<Exhibit> make_exhibits(const CheckPlan& plan, const Rows& rows,
                                   std::vector<std::string>& nothing);

/// Makes fits.csv: the rows of all fits, each with the name of its plot first.
Table make_fits_csv(const std::vector<Exhibit>& exhibits);

}  // namespace laboratory
