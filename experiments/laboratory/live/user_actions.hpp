#pragma once
// Orders and faults that a user gives on the live page, in the form that experiment files have.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"

namespace laboratory {

/// An executed [[order]] or [[fault]].
struct UserAction {
  std::string table;  ///< table of the experiment file: "order" or "fault"
  /// simulated time of its execution in seconds, as in the key at_s of the file
  double at_s = 0;
  /// keys of the order or fault except at_s, with their values as TOML spells them
  std::vector<std::pair<std::string, std::string>> keys;
};

/// Converts an order from a page, such as {"min_influence": 0.1, "area": [0, 0, 8, 8]}, to a record
/// of the program's list `list`. Throws BadInput for unknown keys, and for values of the wrong type
/// or size.
std::any read_order(const programs::RecordList& list, const nlohmann::ordered_json& order);
/// Converts an order from a page to the form of the experiment file.
UserAction make_action(double at_s, const nlohmann::ordered_json& order);

/// Describes the limits of a stage, which an order may also set, for the page: name, help, unit,
/// type and range.
nlohmann::ordered_json describe_limits(const programs::RecordList& stages);
/// Lists the values of `limits`, a record of a stage, in the order of describe_limits().
nlohmann::ordered_json list_limits(const programs::RecordList& stages, const std::any& limits);

}  // namespace laboratory
