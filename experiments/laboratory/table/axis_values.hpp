// What the axes of a table do, and how people call their values.
#pragma once

#include <string>
#include <vector>

#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// Rows of a table, as indices.
using RowList = std::vector<std::size_t>;

RowList all_rows(const Table& table);

/// The different values of a column in these rows, in their order; empty cells do not count.
std::vector<Value> distinct(const Table& table, const RowList& rows, std::size_t column);

/// Whether an axis has one value for each combination of values of `others`: coupled ones, or those
/// of a diagonal of the sweep. False without others.
bool is_determined(const Table& table, const RowList& rows, std::size_t axis,
                   const std::vector<std::size_t>& others);

/// "tree, 3200 objects": the values of these axes, without the empty ones.
std::string name_values(const Table& table, std::size_t row, const std::vector<std::size_t>& axes);

/// Whether the numbers are positive and span more than a decade, so that a linear scale would crowd
/// the smaller ones: 50, 200, 800, 3200.
bool is_geometric(const std::vector<double>& values);

/// The numbers of a column.
std::vector<double> numbers_of(const Table& table, const RowList& rows, std::size_t column);

}  // namespace laboratory
