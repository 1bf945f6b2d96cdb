#pragma once
// Table of results: named columns, one or more rows per sweep point, typed cells.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace laboratory {

/// A cell; std::monostate is an empty cell.
using Value = std::variant<std::monostate, std::int64_t, double, std::string>;

struct Table {
  std::vector<std::string> columns;  ///< names of the columns, distinct and not empty
  std::size_t axes = 0;              ///< number of axes of the sweep, which are the first columns
  std::vector<std::vector<Value>> rows;
  std::vector<std::size_t> points = {};  ///< point of each row, ascending; empty: row i is point i

  std::size_t point_of(std::size_t row) const;
  std::size_t row_of(std::size_t point) const;  ///< first row of a point; every point has one
  std::size_t count_points() const;
  /// index of a column; none if unknown
  std::optional<std::size_t> find(std::string_view column) const;
};

/// The number in a cell of either numeric type; none for strings and empty cells.
std::optional<double> as_number(const Value& value);

/// True if two cells are equal. Numbers are compared by value, whatever their type.
bool is_same(const Value& a, const Value& b);

/// Converts a string that spells a number, as in quoted CSV cells, to that number. Other cells stay
/// unchanged.
Value unquote_number(const Value& value);
/// Converts a number to a cell. Integral numbers become integers.
Value to_cell(double value);

/// Formats a cell; "" for an empty one. Doubles have the shortest form that reads back as the same
/// double.
std::string to_string(const Value& value);

/// The number of characters of a UTF-8 text.
std::size_t width_of(const std::string& text);

/// Joins texts: "a, b, c" for the separator ", ".
std::string join_texts(const std::vector<std::string>& texts, std::string_view separator);

/// Makes a label from a column's name, with the unit in brackets: "time_per_ray_ms" becomes "time
/// per ray [ms]".
std::string make_label(std::string_view column);
/// The unit in a column's name; empty if there is none.
std::string unit_of(std::string_view column);
/// Removes the unit from a label: "time per ray [ms]" becomes "time per ray".
std::string without_unit(const std::string& label);

/// Formats the cells of a column for display. All doubles of the column have the same number of
/// decimals, so that the largest has four significant digits. If they span more than three decades
/// (two if all are below 1), each has four significant digits. Columns whose names end with % have
/// two decimals.
std::vector<std::string> format_column(const Table& table, std::size_t column);

/// The indices of the columns to show; all columns if `shown` is empty. Throws BadInput with the
/// known names for an unknown name.
std::vector<std::size_t> find_all(const Table& table, const std::vector<std::string>& shown);

/// True if a column has only numbers and empty cells. It is then aligned to the right.
bool is_numeric(const Table& table, std::size_t column);

/// Formats a table for a terminal with aligned columns: names, a rule, one line per row. `shown`
/// selects columns as in `find_all`.
std::string to_text(const Table& table, const std::vector<std::string>& shown = {});

/// Formats a table as CSV (RFC 4180) with '\n' as line ends, in the same bytes on any host.
/// `parse_csv` restores columns and typed cells. A double always has a decimal point or an
/// exponent, or is inf or nan. Strings that look like numbers are quoted. `axes` is not stored.
std::string to_csv(const Table& table);

/// Puts a ' before each text that a spreadsheet would take for a formula.
Table guard_formulas(Table table);
/// Reads the output of to_csv, and everything that base::CsvReader accepts. Blank lines are
/// skipped, except as rows of a table with one column. A quoted cell is a string. A bare cell is an
/// integer, else a double, else a string. `axes` is 0. Throws BadInput "name:line: ...".
Table parse_csv(std::string_view text, std::string_view name);

}  // namespace laboratory
