#pragma once
// One point of an experiment: what is wrong with it, and its run.
#include <filesystem>

#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/point_result.hpp"
#include "simulator/observe/spectator.hpp"

namespace laboratory {

/// Throws BadInput for files that are not there, and what the program's check throws.
void check_point(const Experiment& experiment);

/// Throws BadInput for several threads, RunOptions::threads, where a point runs on one.
void check_threads(const RunOptions& options, const Experiment& experiment);

/// Checks the files that show what a point's processors and links did, --trace, --timeline and
/// --animate, for a run of so many points. Throws BadInput for a name with an ending that says no
/// format, a place inside of the results folder, or more than one point; std::system_error where no
/// file can be written.
void check_traces(const RunOptions& options, std::size_t points);

/// What is known of a point before it runs: its network and the columns that its program describes.
PointResult describe_point(const Experiment& experiment);

/// Runs the program of a point as the options say and puts its images into the folder `images`,
/// each in a file named by its content. Writes the traces and films, even if a fault ends the
/// simulation. Throws what the program throws, but Unfinished. `spectator`: who watches the run;
/// null: nobody.
PointResult run_point(const Point& point, const RunOptions& options,
                      const std::filesystem::path& images, observe::Spectator* spectator = nullptr);

}  // namespace laboratory
