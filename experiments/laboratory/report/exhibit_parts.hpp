#pragma once
// The parts that a declared figure is made of; see exhibit.hpp.
#include "experiments/laboratory/report/exhibit.hpp"
#include "experiments/laboratory/table/axis_values.hpp"

namespace laboratory {

// A curve with what it was made from.
struct Curve {
  std::string name;
  RowList rows;  // of the points, in the order of x
  std::vector<double> x, y;
};

// One curve for each combination of values of the series' axes. `left_out`: the rows that need
// others that are not there.
std::vector<Curve> make_curves(const CheckPlan::Figure& figure, const Rows& rows,
                               RowList& left_out);

// "200 objects: ", or nothing for the only curve.
std::string describe(const std::string& series);

// Add to the plot of an exhibit, whose first series are these curves, and to its tables.
void add_reference(Exhibit& exhibit, const CheckPlan::Figure& figure, const Rows& rows,
                   const std::vector<Curve>& curves);
void add_fits(Exhibit& exhibit, const CheckPlan::Figure& figure, const Rows& rows,
              const std::vector<Curve>& curves);
void add_optima(Exhibit& exhibit, const CheckPlan::Figure& figure,
                const std::vector<Curve>& curves);

}  // namespace laboratory
