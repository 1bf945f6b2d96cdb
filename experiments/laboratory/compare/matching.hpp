#pragma once
// Finds the points of the sweep that several runs have in common.
#include <string>
#include <vector>

#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// The results table of a run, and the run's name.
struct NamedTable {
  std::string name;
  Table table;
};

/// The tables of several runs, with the rows grouped by point (combination of axis values). Rows of
/// one run that differ only in the seed are samples of the same point.
struct MatchedRuns {
  struct Point {
    std::vector<Value> at;  ///< values of the axes at this point
    /// for each run, the numbers of its rows at this point
    std::vector<std::vector<std::size_t>> rows;
  };
  std::vector<NamedTable> runs;
  std::vector<std::string> axes;  ///< axes that take several values in at least one run
  std::string seed;               ///< name of the seed that takes several values; "": none
  std::vector<Point> points;      ///< points common to all runs, in the order of the first run
  /// for each run, the number of its rows whose point is missing in another run
  std::vector<std::size_t> left_out;
};

/// Groups the rows of the runs by point. Throws BadInput if an axis with several values in one run
/// is missing in another, if two seeds vary independently, or if the runs have no common point.
MatchedRuns match_points(std::vector<NamedTable> runs);

/// Formats the axis values of a point: "workers = 3, objects = 200".
std::string name_point(const MatchedRuns& matched, const MatchedRuns::Point& point);

}  // namespace laboratory
