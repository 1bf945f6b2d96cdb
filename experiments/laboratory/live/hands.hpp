#pragma once
// What a user does to a run that is watched: orders and faults, read from a page and kept as the
// experiment file would say them.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"

namespace laboratory {

/// An [[order]] or [[fault]] that happened.
struct Deed {
  std::string table;                                      ///< "order" or "fault"
  double at_s = 0;                                        ///< as the file counts it
  std::vector<std::pair<std::string, std::string>> keys;  ///< besides at_s, in TOML's spelling
};

/// The list "order" of a program; null if it has no user.
const programs::RecordList* find_orders(const programs::Program& program);

/// An order of a page, {"min_influence": 0.1, "area": [0, 0, 8, 8]}, as a record of the list.
/// Throws BadInput for a key that the list has not, and for values of the wrong kind or size.
std::any read_order(const programs::RecordList& list, const nlohmann::ordered_json& order);
/// The same order as the file would say it.
Deed make_deed(double at_s, const nlohmann::ordered_json& order);

/// What a page needs to offer the limits of an order: name, help, unit, kind, range, and its value
/// at first, which the file's last [[stage]] may give.
nlohmann::ordered_json describe_limits(const programs::RecordList& list,
                                       const ExperimentFile& file);

}  // namespace laboratory
