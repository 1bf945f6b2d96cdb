#pragma once
// Points that several runs have in common.
#include <string>
#include <vector>

#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// The results of a run with the run's name.
struct NamedTable {
  std::string name;
  Table table;
};

/// Runs with their rows grouped by point. Rows of a run that differ only in the seed are samples of
/// one point.
struct MatchedRuns {
  struct Point {
    std::vector<Value> at;                       ///< a value for each of `axes`
    std::vector<std::vector<std::size_t>> rows;  ///< a list for each run: its rows here
  };
  std::vector<NamedTable> runs;
  std::vector<std::string> axes;      ///< axes that take several values in some run
  std::string seed;                   ///< the seed that takes several values; "": none
  std::vector<Point> points;          ///< common to all runs, in the order of the first run
  std::vector<std::size_t> left_out;  ///< for each run: its number of rows at other points
};

/// True for "seed" and names that end with "_seed".
bool is_seed(const std::string& axis);

/// Throws BadInput if an axis with several values in one run is missing in another, if two seeds
/// vary independently, and if the runs have no point in common.
MatchedRuns match_points(std::vector<NamedTable> runs);

/// "workers = 3, objects = 200"
std::string name_point(const MatchedRuns& matched, const MatchedRuns::Point& point);

}  // namespace laboratory
