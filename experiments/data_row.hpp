#pragma once
// The columns that data managers fill, behind those of the farm.
#include <nlohmann/json.hpp>

#include "simulator/iirra/shared_farm.hpp"

namespace experiments {

nlohmann::ordered_json make_data_row(const iirra::SharedResult& result);
// Of a point whose workers hold the scene, beside others.
nlohmann::ordered_json make_empty_data_row();

}  // namespace experiments
