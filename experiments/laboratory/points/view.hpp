#pragma once
// Selection of columns to show to people: a program may have sixty.
#include <string>
#include <utility>
#include <vector>

#include "experiments/laboratory/points/results.hpp"

namespace laboratory {

struct TableView {
  /// In this order: the axes; other inputs that vary; results that the file refers to; other
  /// results.
  std::vector<std::string> columns;
  std::size_t least = 0;  ///< minimum number of columns, for any width of the terminal
  /// Inputs with the same value in all rows.
  std::vector<std::pair<std::string, std::string>> constants;
  std::vector<std::string> unknown;  ///< a sentence for each requested name that is not a column
};

/// With [report] columns: the axes and these, or all columns. Otherwise: the axes, inputs that
/// vary, and results. Columns of [[check]], [[plot]] and [[best]] come first, including those used
/// through [let]; of the farm's other results only those that answer most questions are shown.
/// `ended` appears only if a point was cut short or failed.
TableView choose_view(const ExperimentFile& file, const Table& table);

/// The view's constants, in lines; its table, `width` characters wide unless its first columns need
/// more; and the number of hidden columns.
std::string to_text(const Table& table, const TableView& view, std::size_t width);

/// The columns of that table.
std::vector<std::string> fit_columns(const Table& table, const TableView& view, std::size_t width);

}  // namespace laboratory
