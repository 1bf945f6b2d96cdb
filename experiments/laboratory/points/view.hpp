#pragma once
// Selection of columns for display, since a program may have sixty columns.
#include <string>
#include <utility>
#include <vector>

#include "experiments/laboratory/points/results.hpp"

namespace laboratory {

struct TableView {
  /// Shown columns, in this order: axes, other inputs that vary, results that the file refers to,
  /// other results.
  std::vector<std::string> columns;
  std::size_t least = 0;  ///< number of columns to show on any terminal, however narrow
  /// Inputs with the same value in all rows: name and value.
  std::vector<std::pair<std::string, std::string>> constants;
  std::vector<std::string> unknown;  ///< one sentence for each requested name that is not a column
};

/// Chooses the columns. In a table of means over seeds, each is followed by its half widths. With
/// [report] columns these are the axes and the named columns, or all columns if one of the names is
/// "all". Otherwise they are the axes, inputs that vary, and results. Results used in [[check]],
/// [[plot]] and [[best]], also through [let], come first. The farm's other results are limited to
/// the most useful ones, and speed-ups to those of most rows. `ended` is shown only if a point
/// failed or was cut short.
TableView choose_view(const ExperimentFile& file, const Table& table);

/// Formats the view: its constants in lines, its table, and the number of hidden columns. The table
/// is `width` characters wide, unless its first columns need more.
std::string to_text(const Table& table, const TableView& view, std::size_t width);

/// The names of the columns that to_text() shows at this width.
std::vector<std::string> fit_columns(const Table& table, const TableView& view, std::size_t width);

}  // namespace laboratory
