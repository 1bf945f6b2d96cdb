#pragma once
// From the points of a sweep to one table.
#include <nlohmann/json.hpp>

#include "experiments/experiment.hpp"
#include "experiments/table.hpp"

namespace experiments {

// One row per point: topology, workers, objects, any other axis, then what `results[i]["row"]` of
// point i holds. Speed-up and efficiency are relative to the row with one worker and otherwise the
// same axes; they stay empty where there is none.
Table make_table(const ExperimentFile& file, const std::vector<nlohmann::ordered_json>& results);

// What the image of a run depends on: points of equal keys must have equal images.
std::string image_key(const Experiment& experiment);
// What its key images depend on beside that: the stages.
std::string stages_key(const Experiment& experiment);
// A file name for it, without extension: "image-spheres-200".
std::string image_name(const Experiment& experiment);

}  // namespace experiments
