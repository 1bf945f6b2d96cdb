#pragma once
// From the points of a sweep to one table.
#include <nlohmann/json.hpp>

#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

// The columns that say which point a row is. Of the farm: topology, workers, objects, any other
// axis. Of a pattern: the axes in the order of the file, those of the network as topology and
// processors.
std::vector<std::string> axis_columns(const ExperimentFile& file);

// The columns of the axes that go with that of `column` in [sweep], itself too; only itself where
// none do.
std::vector<std::string> find_coupled(const ExperimentFile& file, const std::string& column);

// A row for each that the result of a point has: the axes, of a pattern its parts, its network and
// all its parameters too, then what the row holds. Speed-up and efficiency of the farm are relative
// to the row with one worker and otherwise the same axes; they stay empty where there is none.
// Beside them, where they are not empty and there is more than one worker, the serial fractions of
// laws.hpp.
Table make_table(const ExperimentFile& file, const std::vector<nlohmann::ordered_json>& results);

// Points that failed or were cut short may have a shorter row than others, or none.
const nlohmann::ordered_json& longest_row(const std::vector<nlohmann::ordered_json>& results);

bool is_farm(const ExperimentFile& file);
// Whether the row's point came to its end.
bool is_complete_row(const Table& table, const std::vector<Value>& row);
// JSON and TOML values as cells.
Value to_value(const nlohmann::ordered_json& json);
Value to_value(const Coordinate& at);

// What the image of a run depends on: points of equal keys must have equal images.
std::string image_key(const Experiment& experiment);
// What its key images depend on beside that: the stages.
std::string stages_key(const Experiment& experiment);
// A file name for it, without extension: "image-spheres-200".
std::string image_name(const Experiment& experiment);

}  // namespace laboratory
