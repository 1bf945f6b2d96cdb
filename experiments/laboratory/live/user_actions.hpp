#pragma once
// Orders and faults that a user gives on the live page, kept in the form of the experiment file.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"

namespace laboratory {

/// An [[order]] or [[fault]] that was executed.
struct UserAction {
  std::string table;  ///< table of the experiment file: "order" or "fault"
  double at_s = 0;    ///< simulated time of the execution, on the file's time scale
  /// keys of the order or fault except at_s, with values as spelled in TOML
  std::vector<std::pair<std::string, std::string>> keys;
};

/// Converts an order from a page, such as {"min_influence": 0.1, "area": [0, 0, 8, 8]}, to a record
/// of the list. Throws BadInput for unknown keys, and for values of the wrong type or size.
std::any read_order(const programs::RecordList& list, const nlohmann::ordered_json& order);
/// Converts an order from a page to the form of the experiment file.
UserAction make_action(double at_s, const nlohmann::ordered_json& order);

/// Describes the limits of a stage, which an order may also set, for the page: name, help, unit,
/// type, range and initial value. Initial values come from the file's last [[stage]] if it sets
/// them.
nlohmann::ordered_json describe_limits(const programs::RecordList& stages,
                                       const ExperimentFile& file);

}  // namespace laboratory
