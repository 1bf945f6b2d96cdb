#pragma once
// Results of several runs, point by point: how many times the first run's the others' are.
#include <optional>
#include <string>
#include <vector>

#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// The results of a run, and what it is called.
struct NamedTable {
  std::string name;
  Table table;
};

/// The points that several runs have in common. Runs that differ in nothing but their seeds are
/// samples of one point.
struct Matched {
  std::vector<std::string> axes;  ///< of all runs, without seeds and those with one value in each
  /// Of a point, for each run the rows of its table: one, or one for each seed.
  struct Point {
    std::vector<Value> at;  ///< of `axes`
    std::vector<std::vector<std::size_t>> rows;
  };
  std::vector<Point> points;          ///< in the order of the first run
  std::vector<std::string> seeds;     ///< the axes of seeds, of all runs
  std::vector<std::size_t> left_out;  ///< of each run: rows whose points some other has not
};

/// Whether an axis is a seed: "seed", or one that ends with "_seed".
bool is_seed(const std::string& axis);

/// Throws BadInput for an axis that takes several values in one run and is none of another's, and
/// for runs without a point in common.
Matched match_points(const std::vector<NamedTable>& runs);

/// A result of one run in comparison with the first run's.
struct Ratio {
  double value = 0;  ///< of the means; with seeds the geometric mean of the ratios
  /// Where it is with 95 %, by Student's t on logarithms: of pairs with one seed where all seeds
  /// are in both runs, else by Welch. None for fewer than two samples in one of them.
  std::optional<std::pair<double, double>> interval = {};
  std::size_t samples = 0;  ///< the fewer of both
};

/// None where a sample is missing, is no number or not above zero.
std::optional<Ratio> find_ratio(const std::vector<NamedTable>& runs, const Matched& matched,
                                const Matched::Point& point, std::size_t run,
                                const std::string& column);

/// A row for each point: the axes; the result of each run, "NAME: COLUMN", the mean over seeds; and
/// of each but the first "NAME / FIRST", with seeds also its interval, "0.97 to 1.02".
Table compare_column(const std::vector<NamedTable>& runs, const Matched& matched,
                     const std::string& column);

/// The ratios of one run at all points that have one.
struct Spread {
  std::size_t points = 0;  ///< at least one
  double mean = 0;         ///< geometric
  double least = 0, most = 0;
  const Matched::Point *least_at = nullptr, *most_at = nullptr;
  std::size_t with_interval = 0, surely_less = 0, surely_more = 0;  ///< points: intervals below 1,
                                                                    ///< above 1
  bool is_same() const { return least == 1 && most == 1; }
};
/// None where no point has a ratio. Points to those of `matched`.
std::optional<Spread> find_spread(const std::vector<NamedTable>& runs, const Matched& matched,
                                  std::size_t run, const std::string& column);

/// "time_s: b is 0.833 of a (geometric mean of 6 points; 0.83 at workers = 1 to ...)"
std::string tell_spread(const std::vector<NamedTable>& runs, const Matched& matched,
                        std::size_t run, const std::string& column, const Spread& spread);

/// The numeric columns that are results in every run.
std::vector<std::string> common_results(const std::vector<NamedTable>& runs);

/// All points, a row for each run and point: the axes "run" and those of `matched`, then these
/// columns, means over seeds.
Table stack_runs(const std::vector<NamedTable>& runs, const Matched& matched,
                 const std::vector<std::string>& columns);

}  // namespace laboratory
