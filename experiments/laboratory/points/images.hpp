#pragma once
// Storage of the images of points. An image is saved in the folder of the points' records first,
// and placed among the results at the end.
#include <filesystem>
#include <vector>

#include "experiments/laboratory/points/point_result.hpp"

namespace laboratory {

/// Saves each image in `folder`, in a file whose name is a hash of its content.
std::vector<SavedImage> save_images(const std::vector<programs::Image>& images,
                                    const std::filesystem::path& folder);

/// Gives each image a caption and a file in `folder`, named after the image and the axes whose
/// values all its points share. Equal images share a file. The image of a scene must not depend on
/// the topology, the number of processors or the timing: throws base::InvariantBroken if it does.
void place_images(const ExperimentFile& file, Results& results,
                  const std::filesystem::path& records, const std::filesystem::path& folder);

}  // namespace laboratory
