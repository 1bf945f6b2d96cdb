#pragma once
// Simulation of one point that also records a trace, a chart of activity and films.
#include "experiments/laboratory/points/points.hpp"

namespace laboratory {

/// Checks the output files of --trace, --timeline and --animate for a run with `points` points.
/// Throws BadInput if an extension has no known format, if a file would lie inside the results
/// folder, if the run has more than one point, or if the point's program cannot draw the requested
/// film. Throws std::system_error if a file cannot be written.
void check_recordings(const RunOptions& options, const ExperimentFile& file, std::size_t points);

/// Returns a function that runs a point as run_point() does, and writes the requested recordings,
/// even if a fault ends the simulation. Timelines have the size and font of [report].
RunPoint record_points(const ExperimentFile& file);

}  // namespace laboratory
