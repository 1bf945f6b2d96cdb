#pragma once
// What the axes of a table do, and what people call their values.

#include <string>
#include <vector>

#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// Rows of a table, as indices.
using RowList = std::vector<std::size_t>;

RowList all_rows(const Table& table);

/// The different values of a column in these rows, in the order of the rows; empty cells do not
/// count.
std::vector<Value> distinct(const Table& table, const RowList& rows, std::size_t column);

/// Whether an axis has one value for each combination of values of `others`, as coupled axes have,
/// and those of a diagonal of the sweep. False without others.
bool is_determined(const Table& table, const RowList& rows, std::size_t axis,
                   const std::vector<std::size_t>& others);

/// Names the values of these axes, without the empty ones: "tree, 3200 objects".
std::string name_values(const Table& table, std::size_t row, const std::vector<std::size_t>& axes);

/// Whether the numbers are positive and span more than a decade, so that a linear scale would crowd
/// the smaller ones: 50, 200, 800, 3200.
bool is_geometric(const std::vector<double>& values);

/// The numbers of a column.
std::vector<double> numbers_of(const Table& table, const RowList& rows, std::size_t column);

}  // namespace laboratory
