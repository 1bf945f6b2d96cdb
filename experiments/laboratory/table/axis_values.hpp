#pragma once
// Values of a table's axes: selection, dependence and names for people.

#include <string>
#include <vector>

#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// Rows of a table, as indices.
using RowList = std::vector<std::size_t>;

RowList all_rows(const Table& table);

/// The distinct values of a column in these rows, in the order of the rows; ignores empty cells.
std::vector<Value> distinct(const Table& table, const RowList& rows, std::size_t column);

/// True if an axis has one value for each combination of values of `others`. This is true of
/// coupled axes, and on a diagonal of the sweep. False without others.
bool is_determined(const Table& table, const RowList& rows, std::size_t axis,
                   const std::vector<std::size_t>& others);

/// Names the values of these axes, without the empty ones: "tree, 3200 objects".
std::string name_values(const Table& table, std::size_t row, const std::vector<std::size_t>& axes);

/// True if the numbers are positive and span more than a decade, so that a linear scale would crowd
/// the smaller ones: 50, 200, 800, 3200.
bool is_geometric(const std::vector<double>& values);

/// The numbers of a column.
std::vector<double> numbers_of(const Table& table, const RowList& rows, std::size_t column);

}  // namespace laboratory
