#pragma once
// Checks all points of an experiment, and then simulates them in parallel, each in a process of its
// own.
#include <filesystem>
#include <functional>

#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/point_result.hpp"

namespace laboratory {

/// Throws BadInput for an error in any point, or in options that concern points, before the first
/// point is simulated.
void check_points(const RunOptions& options, const ExperimentFile& file);

/// Callback that examines the result of a point as soon as it exists. It throws if the file's
/// checks and plots use names that the result lacks.
using Inspect = std::function<void(const Point& point, const PointResult& result)>;

/// Function that simulates a point, with the contract of run_point().
using RunPoint = std::function<PointResult(const Point& point, const RunOptions& options,
                                           const std::filesystem::path& images)>;

/// Draws a failed point. Returns the end of the failure's message, which lists the files of the
/// drawings.
using Explain = std::function<std::string(const Point& point, const RunOptions& options,
                                          const PointResult& failure)>;

/// The points to run, and where their records are.
struct PointsPlan {
  PointsPlan(const RunOptions& options, const ExperimentFile& file, Inspect inspect = {},
             RunPoint run = {}, Explain explain = {});

  const RunOptions& options;
  const ExperimentFile& file;
  Inspect inspect;
  RunPoint run;                   ///< simulates a point; none: run_point()
  Explain explain;                ///< draws a failed point; may be empty
  std::filesystem::path results;  ///< folder with records to use and to add to
  /// folder for records that only these results may use; "": not saved
  std::filesystem::path lone;
  std::vector<std::string> keys;  ///< for each point, the key of its record
  nlohmann::ordered_json origin;  ///< description of the experiment (see make_origin)
};

/// Finds the recorded results of the points with these numbers; all other results stay empty. Uses
/// no records with --profile, --trace, --timeline and --animate, which need a simulation.
Results find_points(const PointsPlan& plan, const std::vector<std::size_t>& numbers);

/// Simulates the points with these numbers, and records each result as soon as it exists. Reports a
/// failure on standard error at once, and continues with the other points. If the user interrupts,
/// some results stay empty. Throws Failure for bad input. Throws Interrupted at a second interrupt,
/// or if there is no result at all.
void run_points(const PointsPlan& plan, const std::vector<std::size_t>& numbers, Results& results);

/// True if the point's record is valid only for the results in the same folder.
bool is_lone(const Experiment& experiment, const PointResult& result);

}  // namespace laboratory
