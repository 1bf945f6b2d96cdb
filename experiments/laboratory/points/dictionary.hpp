#pragma once
// What the columns of a table of results are, for programs that read it.
#include <nlohmann/json.hpp>

#include "experiments/laboratory/points/results.hpp"

namespace laboratory {

/// results.schema.json: a Table Schema (https://specs.frictionlessdata.io/table-schema) of
/// results.csv. Of each column its name, type, title and meaning; its unit, where it has one; and
/// the programs that give it. The primary key is made of the axes.
nlohmann::ordered_json make_dictionary(const ExperimentFile& file, const Table& table);

}  // namespace laboratory
