#pragma once
// The images that a pattern's runs have made.
#include <filesystem>

#include "experiments/laboratory/points/point_result.hpp"

namespace laboratory {

// Puts them into `folder`, each in a file named by its content. Of each "name"; "file"; "exr", the
// same with all its range, and "at_s" where it has them.
nlohmann::ordered_json save_images(const std::vector<programs::Image>& images,
                                   const std::filesystem::path& folder);

// Makes the images in `folder` that the results name in `records`, equal ones of one name once:
// called by name and by the axes that set it apart, "image-picture-bicubic.png". Of each image
// "path" and "exr" are then the names there, and "caption" says what it is.
void place_pattern_images(const ExperimentFile& file, Results& results,
                          const std::filesystem::path& records,
                          const std::filesystem::path& folder);

}  // namespace laboratory
