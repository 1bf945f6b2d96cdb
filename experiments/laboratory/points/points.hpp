#pragma once
// Execution of an experiment's points: checked together, then run in parallel, each in its own
// process.
#include <filesystem>
#include <functional>

#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/point_result.hpp"

namespace laboratory {

/// Throws BadInput for an error in any point, or in options for points, before the first point
/// runs.
void check_points(const RunOptions& options, const ExperimentFile& file);

/// Callback that examines the result of a point as soon as it exists. Throws if the file's checks
/// and plots use names that the result lacks.
using Inspect = std::function<void(const Point& point, const PointResult& result)>;

/// Runs a point, like run_point().
using RunPoint = std::function<PointResult(const Point& point, const RunOptions& options,
                                           const std::filesystem::path& images)>;

/// The points to run, and where their records are.
struct PointsPlan {
  PointsPlan(const RunOptions& options, const ExperimentFile& file, Inspect inspect = {},
             RunPoint run = {});

  const RunOptions& options;
  const ExperimentFile& file;
  Inspect inspect;
  RunPoint run;                   ///< none: run_point()
  std::filesystem::path results;  ///< folder with records to use and to add to
  /// folder for records that only these results may use; "": not saved
  std::filesystem::path lone;
  std::vector<std::string> keys;  ///< record key of each point
  nlohmann::ordered_json origin;  ///< origin of the results (see make_origin)
};

/// Finds the recorded results of the points with these numbers. Finds none under --profile,
/// --trace, --timeline or --animate.
Results find_points(const PointsPlan& plan, const std::vector<std::size_t>& numbers);

/// Runs the points with these numbers and records each result as soon as it exists. A failure is
/// reported on standard error at once, and the other points continue. After an interrupt by the
/// user, some results are missing. Throws Failure for bad input. Throws Interrupted at a second
/// interrupt, or if there is no result at all.
void run_points(const PointsPlan& plan, const std::vector<std::size_t>& numbers, Results& results);

/// True if only these results may use the point's record.
bool is_lone(const Experiment& experiment, const PointResult& result);

}  // namespace laboratory
