#pragma once
// The results of a pattern as a table.
#include <nlohmann/json.hpp>

#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

// A row for each of rows_of(results[i]): the axes of the sweep in the order of the file; the
// pattern's parts, which count as axes; where the pattern uses a network, topology and processors
// unless they are axes; its parameters that are no axes; then what the row holds. Of a point that
// did not end there is one row, its parts empty. A result that is an input as well ("processors")
// has one column; throws base::InvariantBroken where the two differ.
Table make_pattern_table(const ExperimentFile& file,
                         const std::vector<nlohmann::ordered_json>& results);

// The first column of such a table that is a result and not an input as well; none if all are.
std::vector<std::string> first_result(const ExperimentFile& file, const Table& table);

}  // namespace laboratory
