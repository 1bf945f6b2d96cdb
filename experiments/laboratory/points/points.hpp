#pragma once
// The points of an experiment: checked together, run in parallel, each in its own process.
#include <filesystem>
#include <functional>

#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/point_result.hpp"

namespace laboratory {

/// Throws BadInput for an error in any point, or in options that refer to points, before the first
/// one runs. `chosen` is the number of points to be run.
void check_points(const RunOptions& options, const ExperimentFile& file, std::size_t chosen);

/// Examines the result of a point as soon as it exists. Throws if the file's checks and figures use
/// names that it lacks.
using Inspect = std::function<void(const Point& point, const PointResult& result)>;

/// The points to run, and the place of their records.
struct PointsPlan {
  PointsPlan(const RunOptions& options, const ExperimentFile& file, Inspect inspect = {});

  const RunOptions& options;
  const ExperimentFile& file;
  Inspect inspect;
  std::filesystem::path results;  ///< the folder with the records that are used and added to
  std::filesystem::path lone;     ///< folder for lone records; "": not saved
  std::vector<std::string> keys;  ///< of each point
  nlohmann::ordered_json origin;  ///< see make_origin
};

/// Finds the results of these points among the records. With --profile, --trace, --timeline or
/// --animate there are none.
Results find_points(const PointsPlan& plan, const std::vector<std::size_t>& numbers);

/// Runs the points of these numbers and stores their results; each is recorded upon its end.
/// Failures are reported on standard error at once, and the others continue. An interrupt by the
/// user leaves some results missing. Throws Failure for bad input, and Interrupted at a second
/// interrupt or if there is no result at all.
void run_points(const PointsPlan& plan, const std::vector<std::size_t>& numbers, Results& results);

/// True if its record belongs to these results only.
bool is_lone(const Experiment& experiment, const PointResult& result);

}  // namespace laboratory
