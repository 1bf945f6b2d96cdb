#pragma once
// The images of an experiment's results: one for all points that have the same.
#include <filesystem>

#include "experiments/laboratory/points/point_result.hpp"

namespace laboratory {

// Of each point the image that it is to have in `folder`, "" for most: the first point that has one
// stands for all whose images are equal. Makes these files of those that the results name in
// `records`, and beside them key images of the first of these points that has any: their names
// "path" take the place of "file" in its result. The others' results keep none. Throws
// base::InvariantBroken where images differ that must be equal.
std::vector<std::string> place_images(const ExperimentFile& file, Results& results,
                                      const std::filesystem::path& records,
                                      const std::filesystem::path& folder);

}  // namespace laboratory
