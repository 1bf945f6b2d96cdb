#pragma once
// Ratios between the results of other runs and those of the first run.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/laboratory/compare/matching.hpp"

namespace laboratory {

/// A result of one run at one point, divided by the first run's.
struct Ratio {
  double value = 0;  ///< with several seeds, the ratio of the geometric means
  /// Its 95 % interval by Student's t on logarithms: paired by seed if both runs have the same
  /// seeds, else Welch's test. None if a run has one sample.
  std::optional<std::pair<double, double>> interval = {};
};

/// The ratio at a point; none if a sample of either run is not a number, infinite or not above 0.
std::optional<Ratio> find_ratio(const MatchedRuns& matched, const MatchedRuns::Point& point,
                                std::size_t run, const std::string& column);

/// The ratios of one run at all points.
struct Spread {
  std::size_t points = 0;  ///< points with a ratio; if 0, the next five members have no meaning
  double mean = 0;         ///< geometric
  double least = 0, most = 0;
  const MatchedRuns::Point *least_at = nullptr, *most_at = nullptr;
  std::size_t intervals = 0;  ///< points whose ratio has an interval
  std::size_t below = 0;      ///< intervals that end below 1
  std::size_t above = 0;      ///< intervals that begin above 1
  std::size_t others = 0;     ///< points without a ratio at which the two runs differ
  const MatchedRuns::Point* other = nullptr;  ///< the first of `others`

  bool is_same() const { return (points == 0 || (least == 1 && most == 1)) && others == 0; }
};
/// The result points into `matched`.
Spread find_spread(const MatchedRuns& matched, std::size_t run, const std::string& column);

/// "time_s: b is 0.83 times a (geometric mean of 6 points; 0.81 at workers = 1 to 0.84 at ...)"
std::string tell_spread(const MatchedRuns& matched, std::size_t run, const std::string& column,
                        const Spread& spread);

/// The numeric columns that are results in every run.
std::vector<std::string> find_common_results(const std::vector<NamedTable>& runs);

/// A table for people with a row for each point: the axes; the result of each run ("NAME: COLUMN"),
/// a mean over seeds; for each other run the ratio ("NAME / FIRST"), and its interval ("0.97 to
/// 1.02") if some point has one.
Table compare_column(const MatchedRuns& matched, const std::string& column);

/// A table for programs with a row for each result, point and run other than the first: "result",
/// the axes, "run", "value", "first" (the first run's value), "ratio", the interval's "low",
/// "high".
Table list_ratios(const MatchedRuns& matched, const std::vector<std::string>& columns);

/// A table with a row for each run and point: "run", the other axes, and these columns.
Table stack_runs(const MatchedRuns& matched, const std::vector<std::string>& columns);

}  // namespace laboratory
