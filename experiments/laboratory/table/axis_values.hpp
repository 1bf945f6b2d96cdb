#pragma once
// Values of a table's axes: choosing them, finding dependent axes, and showing them.

#include <string>
#include <vector>

#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// row numbers of a table, from 0
using RowList = std::vector<std::size_t>;

RowList all_rows(const Table& table);

/// The distinct values of a column in these rows, in the order of their first rows. Omits empty
/// cells.
std::vector<Value> distinct(const Table& table, const RowList& rows, std::size_t column);

/// True if the axes `others` determine the value of `axis`: no combination of their values occurs
/// with two values of `axis`. This holds for axes that change together. False if `others` is empty.
bool is_determined(const Table& table, const RowList& rows, std::size_t axis,
                   const std::vector<std::size_t>& others);

/// Formats the values of some axes in a row: "tree, 3200 objects". Omits empty values.
std::string name_values(const Table& table, std::size_t row, const std::vector<std::size_t>& axes);

/// True if the numbers are positive and the largest is more than ten times the smallest, as for 50,
/// 200, 800, 3200. Such values need a logarithmic scale.
bool is_geometric(const std::vector<double>& values);

/// The numbers of a column in these rows.
std::vector<double> numbers_of(const Table& table, const RowList& rows, std::size_t column);

}  // namespace laboratory
