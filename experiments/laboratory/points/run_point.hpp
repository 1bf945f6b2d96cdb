#pragma once
// One point of an experiment: what is wrong with it, and its run.
#include <filesystem>

#include "experiments/laboratory/points/point_result.hpp"
#include "simulator/observe/watch.hpp"

namespace laboratory {

/// Throws for files that are not there, and what the program's check throws.
void check_point(const Experiment& experiment);

/// What is known of a point before it runs: its network and the columns that its program describes.
PointResult describe_point(const Experiment& experiment);

/// Runs the program of a point and puts its images into the folder `images`, each in a file named
/// by its content. `watch` has its limit, and what is traced; `profile`: measure kernels. Throws
/// what the program throws, but Unfinished.
PointResult run_point(const Experiment& experiment, const std::filesystem::path& images,
                      bool profile, observe::Watch& watch);

}  // namespace laboratory
