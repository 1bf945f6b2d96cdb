#pragma once
// Run of one point that also records a trace, a time line and films.
#include "experiments/laboratory/points/points.hpp"

namespace laboratory {

/// Checks the output files of --trace, --timeline and --animate for a run of `points` points.
/// Throws BadInput for an extension without a known format, a place inside the results folder, more
/// than one point, or a film that the point cannot show. Throws std::system_error if a file cannot
/// be written.
void check_recordings(const RunOptions& options, const ExperimentFile& file, std::size_t points);

/// Runs a point as run_point() does, and writes the requested recordings, even if a fault ends the
/// simulation.
PointResult run_recorded_point(const Point& point, const RunOptions& options,
                               const std::filesystem::path& images);

}  // namespace laboratory
