#pragma once
// Validation and execution of one point of an experiment.
#include <filesystem>

#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/point_result.hpp"
#include "simulator/observe/run_monitor.hpp"

namespace laboratory {

/// Throws BadInput for missing files, and whatever the check of the program throws.
void check_point(const Experiment& experiment);

/// Throws BadInput if RunOptions::threads asks for several threads and the point can use only one.
void check_threads(const RunOptions& options, const Experiment& experiment);

/// Describes a point before its run: its network, and the columns that its program knows in
/// advance.
PointResult describe_point(const Experiment& experiment);

/// Runs the program of a point. Saves its images in the folder `images`, in files named by a hash
/// of their content. Throws all exceptions of the program except Unfinished. `monitor` names the
/// trace, the controller and the observer of the run; `options` sets the interval that it records.
PointResult run_point(const Point& point, const RunOptions& options,
                      const std::filesystem::path& images, observe::RunMonitor monitor = {});

}  // namespace laboratory
