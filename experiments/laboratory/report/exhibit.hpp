// The plots that an experiment declares with [[plot]], with their tables and findings.
#pragma once

#include <string>
#include <vector>

#include "experiments/laboratory/judge/check_plan.hpp"
#include "experiments/laboratory/plot/plot.hpp"

namespace laboratory {

/// A plot with the tables that are shown below it. Tables without rows are not shown.
struct Exhibit {
  Plot plot;
  /// for each point with a published value: simulated value, published value, difference in percent
  Table differences = {};
  /// for each curve and fitted parameter: its value and 95 % confidence interval
  Table fits = {};
  Table optima = {};  ///< for each curve: its maximum, and how the curve goes on after it
  /// notes about points that were left out and laws that could not be fitted
  std::vector<std::string> notes = {};
  /// one sentence for each result of the comparison, the fits and the maxima
  std::vector<std::string> findings = {};
};

/// Makes the plots that have points, in the order of the file. Adds a note to `nothing` about each
/// plot without points. `histograms` is the table of histogram.csv.
std::vector<Exhibit> make_exhibits(const CheckPlan& plan, const Rows& rows, const Table& histograms,
                                   std::vector<std::string>& nothing);

/// Makes fits.csv: the rows of all fits. The first cell of a row is the name of its plot.
Table make_fits_csv(const std::vector<Exhibit>& exhibits);

}  // namespace laboratory
