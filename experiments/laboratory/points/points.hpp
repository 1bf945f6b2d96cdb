#pragma once
// The points of an experiment: checked together, run side by side, each in a process of its own.
#include <filesystem>
#include <functional>

#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/point_result.hpp"

namespace laboratory {

/// Throws BadInput for what is wrong in any point, or in options that speak of points, before the
/// first one runs. `chosen` is the number of points to be run.
void check_points(const RunOptions& options, const ExperimentFile& file, std::size_t chosen);

/// Looks at a point's result as soon as there is one, and throws where the file's checks and
/// figures name what it has not.
using Inspect = std::function<void(const Point& point, const PointResult& result)>;

/// What is to be run, and where its records go.
struct PointsPlan {
  PointsPlan(const RunOptions& options, const ExperimentFile& file, Inspect inspect = {});

  const RunOptions& options;
  const ExperimentFile& file;
  Inspect inspect;
  std::filesystem::path results;  ///< the folder with the records that are used and added to
  std::filesystem::path lone;     ///< where lone records go; "": nowhere
  std::vector<std::string> keys;  ///< of each point
  nlohmann::ordered_json origin;  ///< see make_origin
};

/// Finds the results of these points, as far as their records are there. With --profile, --trace or
/// --timeline there are none.
Results find_points(const PointsPlan& plan, const std::vector<std::size_t>& numbers);

/// Runs the points of these numbers and puts their results in place; each is recorded as soon as it
/// has ended. Those that fail are reported on standard error at once, and the others go on. Where
/// the user interrupts, some results stay away. Throws Failure for bad input, and Interrupted at
/// a second interrupt or where there is no result at all.
void run_points(const PointsPlan& plan, const std::vector<std::size_t>& numbers, Results& results);

/// Whether its record belongs to these results and to no other.
bool is_lone(const Experiment& experiment, const PointResult& result);

}  // namespace laboratory
