#pragma once
// Storage of the points' images: with the records, then among the results.
#include <filesystem>
#include <vector>

#include "experiments/laboratory/points/point_result.hpp"

namespace laboratory {

/// Saves each image in `folder`, in a file named by a hash of its content.
std::vector<SavedImage> save_images(const std::vector<programs::Image>& images,
                                    const std::filesystem::path& folder);

/// Gives each image a caption and a file in `folder`, named after the image and the axes common to
/// its points. Equal images share a file. The image of a scene must not depend on topology, number
/// of processors and timing: throws base::InvariantBroken if it does.
void place_images(const ExperimentFile& file, Results& results,
                  const std::filesystem::path& records, const std::filesystem::path& folder);

}  // namespace laboratory
