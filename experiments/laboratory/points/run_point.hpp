#pragma once
// Checks and simulates one point of an experiment.
#include <filesystem>

#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/point_result.hpp"
#include "simulator/observe/run_monitor.hpp"

namespace laboratory {

/// Throws BadInput for missing files, and the exceptions of the program's own check.
void check_point(const Experiment& experiment);

/// Throws BadInput if RunOptions::threads is more than one and the point supports only one.
void check_threads(const RunOptions& options, const Experiment& experiment);

/// Describes a point before its simulation: its network, and the columns whose values its program
/// knows in advance.
PointResult describe_point(const Experiment& experiment);

/// Simulates a point. Saves its images in the folder `images`, in files named by a hash of their
/// content. Throws all exceptions of the program except Unfinished. `monitor` has the trace, the
/// controller and the observer of the simulation; `options` sets the time interval that they
/// record.
PointResult run_point(const Point& point, const RunOptions& options,
                      const std::filesystem::path& images, observe::RunMonitor monitor = {});

}  // namespace laboratory
