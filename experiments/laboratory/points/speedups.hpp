#pragma once
// What more processors gain.
#include <string>

#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

// Fills the columns speedup and efficiency of rows that came to their end, where the table has
// them and `processors` is an axis: time_s of the row with one processor and otherwise the same
// axes over their own. Empty where there is none.
void add_speedups(Table& table, const std::string& processors);

}  // namespace laboratory
