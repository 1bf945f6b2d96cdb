#pragma once
// How many times the first run's results those of other runs are.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/laboratory/compare/matching.hpp"

namespace laboratory {

/// A result of one run at one point, divided by the first run's.
struct Ratio {
  double value = 0;  ///< with several seeds the ratio of the geometric means
  /// The interval of 95 % around it, by Student's t on logarithms: of the pairs with the same seed
  /// where both runs have the same seeds, else by Welch's test. None where a run has one sample.
  std::optional<std::pair<double, double>> interval = {};
};

/// The ratio at a point; none where a sample of either run is no number, infinite or not above 0.
std::optional<Ratio> find_ratio(const MatchedRuns& matched, const MatchedRuns::Point& point,
                                std::size_t run, const std::string& column);

/// The ratios of one run at all points.
struct Spread {
  std::size_t points = 0;  ///< those that have a ratio; where there are none, the next five mean
                           ///< nothing
  double mean = 0;         ///< geometric
  double least = 0, most = 0;
  const MatchedRuns::Point *least_at = nullptr, *most_at = nullptr;
  std::size_t intervals = 0;  ///< points whose ratio has an interval,
  std::size_t below = 0;      ///< those of them whose interval ends below 1,
  std::size_t above = 0;      ///< and those whose interval begins above 1
  std::size_t others = 0;     ///< points without a ratio at which the two runs differ
  const MatchedRuns::Point* other = nullptr;  ///< the first of them

  bool is_same() const { return (points == 0 || (least == 1 && most == 1)) && others == 0; }
};
/// It points into `matched`.
Spread find_spread(const MatchedRuns& matched, std::size_t run, const std::string& column);

/// "time_s: b is 0.83 times a (geometric mean of 6 points; 0.81 at workers = 1 to 0.84 at ...)"
std::string tell_spread(const MatchedRuns& matched, std::size_t run, const std::string& column,
                        const Spread& spread);

/// The numeric columns that are results in every run.
std::vector<std::string> find_common_results(const std::vector<NamedTable>& runs);

/// A table for people, a row for each point: the axes; the result of each run, "NAME: COLUMN", with
/// several seeds the mean; and for each run but the first the ratio, "NAME / FIRST", and where some
/// point has one its interval, "0.97 to 1.02".
Table compare_column(const MatchedRuns& matched, const std::string& column);

/// A table for programs, a row for each result, point and run but the first: "result", the axes,
/// "run", "value", "first" (the first run's value), "ratio", "low" and "high" (of the interval).
Table list_ratios(const MatchedRuns& matched, const std::vector<std::string>& columns);

/// A table with a row for each run and point: the axes, of which "run" is the first, and these
/// columns.
Table stack_runs(const MatchedRuns& matched, const std::vector<std::string>& columns);

}  // namespace laboratory
