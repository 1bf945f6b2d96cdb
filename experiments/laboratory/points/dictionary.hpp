#pragma once
// Machine-readable description of the columns of results.csv.
#include <nlohmann/json.hpp>

#include "experiments/laboratory/points/results.hpp"

namespace laboratory {

/// Makes results.schema.json, a Table Schema (https://specs.frictionlessdata.io/table-schema) of
/// results.csv. Each column has a name, type, title, meaning, unit (if any), and the programs that
/// produce it. The axes form the primary key.
nlohmann::ordered_json make_dictionary(const ExperimentFile& file, const Table& table);

}  // namespace laboratory
