#pragma once
// Actions of a live run's user: orders and faults, received from a page and kept in the form of the
// experiment file.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"

namespace laboratory {

/// An [[order]] or [[fault]] that was carried out.
struct UserAction {
  std::string table;                                      ///< "order" or "fault"
  double at_s = 0;                                        ///< on the file's time scale
  std::vector<std::pair<std::string, std::string>> keys;  ///< except at_s, in TOML's spelling
};

/// The list "order" of a program; null if it has no user.
const programs::RecordList* find_orders(const programs::Program& program);

/// Converts an order of a page, {"min_influence": 0.1, "area": [0, 0, 8, 8]}, to a record of the
/// list. Throws BadInput for unknown keys, and for values of the wrong kind or size.
std::any read_order(const programs::RecordList& list, const nlohmann::ordered_json& order);
/// The same order in the form of the experiment file.
UserAction make_action(double at_s, const nlohmann::ordered_json& order);

/// A page's description of the limits of an order: name, help, unit, kind, range, and initial
/// value, taken from the file's last [[stage]] if set there.
nlohmann::ordered_json describe_limits(const programs::RecordList& list,
                                       const ExperimentFile& file);

}  // namespace laboratory
