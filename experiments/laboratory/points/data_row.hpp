#pragma once
// The columns that data managers fill, behind those of the farm.
#include <nlohmann/json.hpp>

#include "simulator/farm/shared_farm.hpp"

namespace laboratory {

nlohmann::ordered_json make_data_row(const farm::SharedResult& result);
// Of a point whose workers hold the scene, beside others.
nlohmann::ordered_json make_empty_data_row();

}  // namespace laboratory
