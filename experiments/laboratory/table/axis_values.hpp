#pragma once
// Values of a table's axes: selection, dependence and display.

#include <string>
#include <vector>

#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// Row numbers of a table.
using RowList = std::vector<std::size_t>;

RowList all_rows(const Table& table);

/// The distinct values of a column in these rows, in the order of the rows, without empty cells.
std::vector<Value> distinct(const Table& table, const RowList& rows, std::size_t column);

/// True if each combination of values of `others` has only one value of the axis. This holds for
/// coupled axes, and on a diagonal of the sweep. False if `others` is empty.
bool is_determined(const Table& table, const RowList& rows, std::size_t axis,
                   const std::vector<std::size_t>& others);

/// Formats the values of some axes in a row, without empty ones: "tree, 3200 objects".
std::string name_values(const Table& table, std::size_t row, const std::vector<std::size_t>& axes);

/// True if the numbers are positive and span more than a decade, such as 50, 200, 800, 3200. A
/// linear scale would crowd the smaller ones.
bool is_geometric(const std::vector<double>& values);

/// The numbers of a column in these rows.
std::vector<double> numbers_of(const Table& table, const RowList& rows, std::size_t column);

}  // namespace laboratory
