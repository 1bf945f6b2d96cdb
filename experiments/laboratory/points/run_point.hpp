#pragma once
// One point of an experiment: its validation and its run.
#include <filesystem>

#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/point_result.hpp"
#include "simulator/observe/run_observers.hpp"

namespace laboratory {

/// Throws BadInput for missing files, and everything that the program's check throws.
void check_point(const Experiment& experiment);

/// Throws BadInput for several threads, RunOptions::threads, if a point can use only one.
void check_threads(const RunOptions& options, const Experiment& experiment);

/// Checks the output files of --trace, --timeline and --animate for a run of so many points. Throws
/// BadInput for an ending that is not a known format, a place inside the results folder, or more
/// than one point; std::system_error if a file cannot be written.
void check_traces(const RunOptions& options, std::size_t points);

/// The known properties of a point before it runs: its network and its program's described columns.
PointResult describe_point(const Experiment& experiment);

/// Runs the program of a point with these options and puts its images into the folder `images`, in
/// files named by content. Writes the traces and films, even if a fault ends the simulation. Throws
/// all exceptions of the program except Unfinished. `controller`: observer of the run; null: none.
PointResult run_point(const Point& point, const RunOptions& options,
                      const std::filesystem::path& images,
                      observe::RunController* controller = nullptr);

}  // namespace laboratory
