#pragma once
// Ratios of each run's results to the results of the first run.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/laboratory/compare/matching.hpp"

namespace laboratory {

/// A run's result at one point, divided by the first run's result at this point.
struct Ratio {
  double value = 0;  ///< for several seeds, the ratio of the geometric means
  /// The 95 % interval of the ratio, by Student's t-test on logarithms: paired by seed if both runs
  /// have the same seeds, else in Welch's version for unequal variances. None if a run has only one
  /// sample.
  std::optional<std::pair<double, double>> interval = {};
};

/// Finds the ratio at a point. Omits seeds whose cell is empty in either run. No value if no sample
/// remains, or if a sample of either run is not a finite positive number.
std::optional<Ratio> find_ratio(const MatchedRuns& matched, const MatchedRuns::Point& point,
                                std::size_t run, const std::string& column);

/// Finds the 95 % interval of a run's result at a point with several samples. It is the interval of
/// their geometric mean, by Student's t-test on logarithms, or of their arithmetic mean if a sample
/// is not positive. No value for a single sample.
std::optional<std::pair<double, double>> find_interval_of(const MatchedRuns& matched,
                                                          const MatchedRuns::Point& point,
                                                          std::size_t run,
                                                          const std::string& column);

/// Summary of a run's ratios at all points.
struct Spread {
  /// number of points with a ratio; if 0, the members `mean` to `most_at` are undefined
  std::size_t points = 0;
  double mean = 0;  ///< geometric mean of the ratios
  double least = 0, most = 0;
  const MatchedRuns::Point *least_at = nullptr, *most_at = nullptr;
  std::size_t intervals = 0;  ///< number of points whose ratio has an interval
  std::size_t below = 0;      ///< number of intervals that end below 1
  std::size_t above = 0;      ///< number of intervals that begin above 1
  /// number of points that have no ratio and at which the two runs differ
  std::size_t others = 0;
  const MatchedRuns::Point* other = nullptr;  ///< first of the points counted in `others`

  bool is_same() const { return (points == 0 || (least == 1 && most == 1)) && others == 0; }
};
/// Summarises the ratios of a run. `least_at`, `most_at` and `other` of the result point into
/// `matched`.
Spread find_spread(const MatchedRuns& matched, std::size_t run, const std::string& column);

/// Formats a summary of ratios: "time_s: b is 0.83 times a (geometric mean of 6 points; 0.81 at
/// workers = 1 to 0.84 at ...)", where a and b are names of runs.
std::string tell_spread(const MatchedRuns& matched, std::size_t run, const std::string& column,
                        const Spread& spread);

/// The names of numeric columns that are results, not settings, in every run.
std::vector<std::string> find_common_results(const std::vector<NamedTable>& runs);

/// Makes a table for display, with one row for each point. Its columns are the axes and, for each
/// run, the result "NAME: COLUMN", averaged over seeds. Each run after the first also has a column
/// "NAME / FIRST" for its ratio to the first run, and a column for the interval of the ratio, "0.97
/// to 1.02", if any point has one.
Table compare_column(const MatchedRuns& matched, const std::string& column);

/// Makes a table for other programs, with one row for each combination of a result, a point, and a
/// run other than the first. Its columns are "result", the axes, "run", "value" of this run,
/// "first" (the first run's value), "ratio", and "low" and "high" of the ratio's interval.
Table list_ratios(const MatchedRuns& matched, const std::vector<std::string>& columns);

/// Puts the tables of the runs below each other: one row for each run and point, with the columns
/// "run", the axes, and `columns`.
Table stack_runs(const MatchedRuns& matched, const std::vector<std::string>& columns);

}  // namespace laboratory
