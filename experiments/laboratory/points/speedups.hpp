#pragma once
// Columns that need several rows of a table of results.
#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// Whether the row's point came to its end.
bool is_complete_row(const Table& table, const std::vector<Value>& row);

/// Fills the columns speedup and efficiency where they are empty: relative to the row with one
/// processor and otherwise the same axes. `processors` is the column of an axis.
void add_speedups(Table& table, const std::string& processors);

/// Fills serial_karp_flatt and serial_gustafson (laws.hpp) for every speed-up.
void add_serial_fractions(Table& table, const std::string& processors);

}  // namespace laboratory
