#pragma once
// Table of results: named columns, one or more rows for each point of the sweep, and cells with
// types.

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
  /// number of axes of the sweep; the axes are the first columns
  std::size_t axes = 0;
  std::vector<std::vector<Value>> rows;
  /// for each row, the number of its point, ascending; empty: row i belongs to point i
  std::vector<std::size_t> points = {};
  std::vector<int> lines = {};  ///< for each row, its line in the CSV file; empty if there is none

  std::size_t point_of(std::size_t row) const;
  std::size_t row_of(std::size_t point) const;  ///< the first row of a point; every point has a row
  std::size_t count_points() const;
  /// index of the column with this name; no value if there is none
  std::optional<std::size_t> find(std::string_view column) const;
};

/// The number in a cell, integer or floating-point; no value for strings and empty cells.
std::optional<double> as_number(const Value& value);

/// True if two cells are equal. Compares numbers by value, so that 2 equals 2.0.
bool is_same(const Value& a, const Value& b);

/// Converts a string that spells a number, as quoted cells of CSV files may do, to this number.
/// Returns other cells unchanged.
Value unquote_number(const Value& value);
/// Converts a number to a cell. Integral numbers become integers.
Value to_cell(double value);

/// Formats a cell; "" for an empty cell. Floating-point numbers get the shortest text that reads
/// back as the same number.
std::string to_string(const Value& value);

/// The number of characters in a UTF-8 text, which may be smaller than the number of its bytes.
std::size_t width_of(const std::string& text);

/// Joins texts with a separator between them: "a, b, c".
std::string join_texts(const std::vector<std::string>& texts, std::string_view separator);

/// Makes a label from a column's name, with the unit in brackets: "time_per_ray_ms" becomes "time
/// per ray [ms]".
std::string make_label(std::string_view column);
/// The unit at the end of a column's name; "" if it has none.
std::string unit_of(std::string_view column);
/// Removes the unit from a label: "time per ray [ms]" becomes "time per ray".
std::string without_unit(const std::string& label);

/// Formats the cells of a column for display. All floating-point numbers get the same number of
/// decimals, such that the largest has four significant digits. If the numbers span more than a
/// factor of 1000 (100 if all are below 1), each gets four significant digits instead. Columns
/// whose names end with % get two decimals.
std::vector<std::string> format_column(const Table& table, std::size_t column);

/// The indices of the columns named in `shown`; of all columns if it is empty. Throws BadInput,
/// with the known names, for an unknown name.
std::vector<std::size_t> find_all(const Table& table, const std::vector<std::string>& shown);

/// True if a column has only numbers and empty cells. Such columns are aligned to the right.
bool is_numeric(const Table& table, std::size_t column);

/// Formats a table with aligned columns for a terminal: a line with the columns' names, a line of
/// dashes, and one line for each row. `shown` selects columns as in find_all().
std::string to_text(const Table& table, const std::vector<std::string>& shown = {});

/// Formats a table as CSV (RFC 4180) with '\n' as line end; the bytes are the same on any host.
/// parse_csv() restores columns and typed cells, but not `axes`. A floating-point number always has
/// a decimal point or an exponent, or is inf or nan. Strings that look like numbers are quoted.
std::string to_csv(const Table& table);

/// Puts a ' before each text that a spreadsheet program would execute as a formula.
Table guard_formulas(Table table);
/// Reads the output of to_csv(), and everything that base::CsvReader accepts. A blank line is a row
/// if the table has only one column; otherwise it is skipped. A quoted cell is a string. A cell
/// without quotes is an integer, else a floating-point number, else a string. Sets `axes` to 0.
/// Throws BadInput "name:line: ...".
Table parse_csv(std::string_view text, std::string_view name);

}  // namespace laboratory
