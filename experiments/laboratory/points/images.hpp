#pragma once
// The images of points: saved with the records, and placed among the results.
#include <filesystem>
#include <vector>

#include "experiments/laboratory/points/point_result.hpp"

namespace laboratory {

/// Saves each in a file of `folder` named by its content.
std::vector<SavedImage> save_images(const std::vector<programs::Image>& images,
                                    const std::filesystem::path& folder);

/// Gives each image a caption and a file in `folder`, named after the image and the axes common to
/// its points; equal images share a file. Throws base::InvariantBroken if points that must show the
/// same differ: images do not depend on topology, number of processors or timing.
void place_images(const ExperimentFile& file, Results& results,
                  const std::filesystem::path& records, const std::filesystem::path& folder);

}  // namespace laboratory
