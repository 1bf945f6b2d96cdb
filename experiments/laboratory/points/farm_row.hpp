#pragma once
// The columns that a run of the farm fills.
#include <nlohmann/json.hpp>

#include "simulator/farm/farm.hpp"

namespace laboratory {

// Name -> number or text, in the order of results.csv; speed-up and efficiency are left empty, they
// need other rows.
nlohmann::ordered_json make_farm_row(const farm::Result& result);

// Shares of the time that each processor and each link direction was busy, and what the farm's
// resources did, the busiest first.
nlohmann::ordered_json make_farm_use(const farm::Result& result);

}  // namespace laboratory
