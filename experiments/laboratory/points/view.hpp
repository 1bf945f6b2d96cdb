#pragma once
// What people are shown first of a table of results: a program may have sixty columns.
#include <string>
#include <utility>
#include <vector>

#include "experiments/laboratory/points/results.hpp"

namespace laboratory {

struct TableView {
  /// In this order: the axes; other inputs that vary; results that the file asks about; other
  /// results.
  std::vector<std::string> columns;
  std::size_t least = 0;  ///< so many of them are shown however narrow the terminal is
  /// Inputs that are the same in all rows, with their value.
  std::vector<std::pair<std::string, std::string>> constants;
  std::vector<std::string> unknown;  ///< names asked for that are no columns, in a sentence each
};

/// With [report] columns the axes and these, or all columns. Without: the axes, inputs that vary,
/// columns that [[check]], [[plot]] and [[best]] are about, by way of [let] too, and the program's
/// other results; of the farm alone those that answer most questions. `ended` only where a point
/// was cut short or failed.
TableView choose_view(const ExperimentFile& file, const Table& table);

/// The view's constants, in lines; its table, `width` characters wide unless its first columns need
/// more; and how many columns it does not have.
std::string to_text(const Table& table, const TableView& view, std::size_t width);

/// The columns of that table.
std::vector<std::string> fit_columns(const Table& table, const TableView& view, std::size_t width);

}  // namespace laboratory
