#pragma once
// Validation and execution of one point of an experiment.
#include <filesystem>

#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/point_result.hpp"
#include "simulator/observe/run_observers.hpp"

namespace laboratory {

/// Throws BadInput for missing files, and whatever the check of the program throws.
void check_point(const Experiment& experiment);

/// Throws BadInput if RunOptions::threads asks for several threads and the point can use only one.
void check_threads(const RunOptions& options, const Experiment& experiment);

/// Checks the output files of --trace, --timeline and --animate for a run of so many points. Throws
/// BadInput for an extension without a known format, a place inside the results folder, or more
/// than one point. Throws std::system_error if a file cannot be written.
void check_traces(const RunOptions& options, std::size_t points);

/// Describes a point before its run: its network, and the columns that its program knows in
/// advance.
PointResult describe_point(const Experiment& experiment);

/// Runs the program of a point. Saves its images in the folder `images`, in files named by a hash
/// of their content. Writes traces and films even if a fault ends the simulation. Throws all
/// exceptions of the program except Unfinished. `controller` observes the run; null: none.
PointResult run_point(const Point& point, const RunOptions& options,
                      const std::filesystem::path& images,
                      observe::RunController* controller = nullptr);

}  // namespace laboratory
