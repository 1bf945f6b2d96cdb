#pragma once
// The images of points: saved with the records, and placed among the results.
#include <filesystem>
#include <vector>

#include "experiments/laboratory/points/point_result.hpp"

namespace laboratory {

/// Saves each in a file of `folder` that is named by its content.
std::vector<SavedImage> save_images(const std::vector<programs::Image>& images,
                                    const std::filesystem::path& folder);

/// Gives each image a file in `folder`, named after the image and the axes that its points have in
/// common, and a caption; equal images share a file. Throws base::InvariantBroken where points that
/// must show the same do not: the image does not depend on topology, number of processors or
/// timing.
void place_images(const ExperimentFile& file, Results& results,
                  const std::filesystem::path& records, const std::filesystem::path& folder);

}  // namespace laboratory
