// The figures that an experiment declares: [[plot]] over its results, with what they tell.
#pragma once

#include <string>
#include <vector>

#include "experiments/laboratory/judge/check_plan.hpp"
#include "experiments/laboratory/report/plot.hpp"

namespace laboratory {

/// A figure and the tables below it; tables without rows are not shown.
struct Exhibit {
  Plot plot;
  Table differences =
      {};             ///< a row for each point with a reference: predicted, reference, difference %
  Table fits = {};    ///< a row for each curve and parameter, with its 95 % confidence interval
  Table optima = {};  ///< a row for each curve: its largest y, and what comes after
  std::vector<std::string> notes = {};     ///< points left out, laws that were not fitted
  std::vector<std::string> findings = {};  ///< sentences
};

/// Makes the figures that have points, in the order of the file. Adds a note to `nothing` for each
/// figure without points.
std::vector<Exhibit> make_exhibits(const CheckPlan& plan, const Rows& rows,
                                   std::vector<std::string>& nothing);

/// The rows of all fits with the plot's name first: fits.csv.
Table make_fits_csv(const std::vector<Exhibit>& exhibits);

}  // namespace laboratory
