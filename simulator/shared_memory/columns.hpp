#pragma once
// What is said of data managers wherever they are used.
#include "base/fields.hpp"
#include "simulator/shared_memory/data_manager.hpp"

namespace shared_memory {

/// accesses_made, where items were found, requests, and what these took or were spared. Shares of
/// nothing are 0.
base::Columns<DataUse> data_columns();

}  // namespace shared_memory
