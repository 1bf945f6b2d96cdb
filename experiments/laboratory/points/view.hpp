#pragma once
// Selection of the columns to display, since a program may have sixty columns.
#include <string>
#include <utility>
#include <vector>

#include "experiments/laboratory/points/results.hpp"

namespace laboratory {

struct TableView {
  /// Shown columns, in this order: axes, other inputs that vary, results that the experiment file
  /// uses, other results.
  std::vector<std::string> columns;
  std::size_t least = 0;  ///< number of columns that are shown even on narrow terminals
  /// Names and values of the inputs that have the same value in all rows.
  std::vector<std::pair<std::string, std::string>> constants;
  /// one sentence for each name in [report] that is not a column
  std::vector<std::string> unknown;
};

/// Chooses the columns to display. If the file has `columns` in [report], these are the axes and
/// the named columns, or all columns if a name is "all". Otherwise they are the axes, the inputs
/// that vary, and results. Results that [[check]], [[plot]] and [[best]] use, also through [let],
/// come first. Other results of a farm are limited to the most useful ones, and speed-ups are shown
/// only if most rows have one. `ended` is shown only if a point failed or was ended early. In a
/// table of means over seeds, each mean is followed by its half width.
TableView choose_view(const ExperimentFile& file, const Table& table);

/// Formats the chosen columns: lines with the constant inputs, the table, and the number of hidden
/// columns. The table is at most `width` characters wide, unless its first columns need more.
std::string to_text(const Table& table, const TableView& view, std::size_t width);

/// The names of the columns that to_text() shows if the terminal is `width` characters wide.
std::vector<std::string> fit_columns(const Table& table, const TableView& view, std::size_t width);

}  // namespace laboratory
