#pragma once
// Points that several runs have in common.
#include <string>
#include <vector>

#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// The results of a run, and what the run is called.
struct NamedTable {
  std::string name;
  Table table;
};

/// Runs, and their rows sorted by points. Rows of a run that differ only in the seed are samples of
/// one point.
struct MatchedRuns {
  struct Point {
    std::vector<Value> at;                       ///< a value for each of `axes`
    std::vector<std::vector<std::size_t>> rows;  ///< a list for each run: its rows at this point
  };
  std::vector<NamedTable> runs;
  std::vector<std::string> axes;      ///< axes that take several values in some run
  std::string seed;                   ///< the seed that takes several values; "" where none does
  std::vector<Point> points;          ///< those that all runs have, in the order of the first run
  std::vector<std::size_t> left_out;  ///< a number for each run: its rows at other points
};

/// Whether the axis is a seed: "seed", or a name that ends with "_seed".
bool is_seed(const std::string& axis);

/// Throws BadInput where an axis takes several values in one run and another run does not have it,
/// where two seeds take several values independently, and where no point is in all runs.
MatchedRuns match_points(std::vector<NamedTable> runs);

/// "workers = 3, objects = 200"
std::string name_point(const MatchedRuns& matched, const MatchedRuns::Point& point);

}  // namespace laboratory
