#pragma once
// The declared figures of an experiment: [[plot]] over its results, with what they tell.
#include <string>
#include <vector>

#include "experiments/laboratory/judge/check_plan.hpp"
#include "experiments/laboratory/report/plot.hpp"

namespace laboratory {

// A figure with the tables below it; tables without rows are not shown.
struct Exhibit {
  Plot plot;
  Table differences;  // a row per point with a reference: predicted, reference, difference in %
  Table fits;         // a row per curve and parameter, with its 95 % confidence interval
  Table optima;       // a row per curve: its largest y, and what comes after
  std::vector<std::string> notes;     // points left out, fits that could not be
  std::vector<std::string> findings;  // a sentence each
};

// In the order of the file, those that have points; a figure without is named in the notes of
// `nothing`.
std::vector<Exhibit> make_exhibits(const CheckPlan& plan, const Rows& rows,
                                   std::vector<std::string>& nothing);

// fits.csv: all of them, with the plot's name first.
Table make_fits_csv(const std::vector<Exhibit>& exhibits);

}  // namespace laboratory
