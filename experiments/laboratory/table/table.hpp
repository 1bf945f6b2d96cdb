#pragma once
// Results as a table: named columns, one row or more per sweep point, typed cells.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace laboratory {

/// A cell; std::monostate is an empty one.
using Value = std::variant<std::monostate, std::int64_t, double, std::string>;

struct Table {
  std::vector<std::string> columns;  ///< distinct, none empty
  std::size_t axes = 0;              ///< the first `axes` columns are the sweep's axes
  std::vector<std::vector<Value>> rows;
  std::vector<std::size_t> points = {};  ///< the point of each row, ascending; empty if equal

  std::size_t point_of(std::size_t row) const;
  std::size_t row_of(std::size_t point) const;  ///< the first row of a point; every point has one
  std::size_t count_points() const;
  std::optional<std::size_t> find(std::string_view column) const;  ///< none for an unknown name
};

/// The number in a cell of either numeric type; none for text and empty cells.
std::optional<double> as_number(const Value& value);

/// True if two cells are equal: numbers by value, whatever their type, all else exactly.
bool is_same(const Value& a, const Value& b);

/// The number in a text, as in quoted cells of a CSV file; other values unchanged.
Value unquote_number(const Value& value);
/// A number as a cell; whole numbers become integers.
Value to_cell(double value);

/// Empty for an empty cell; doubles in the shortest form that reads back as the same double.
std::string to_string(const Value& value);

/// The number of characters of a UTF-8 text.
std::size_t width_of(const std::string& text);

/// "a, b, c" for the separator ", ".
std::string join_texts(const std::vector<std::string>& texts, std::string_view separator);

/// A column's name for people, with its unit in brackets: "time_per_ray_ms" is "time per ray [ms]".
std::string make_label(std::string_view column);
/// That unit, or empty.
std::string unit_of(std::string_view column);
/// "time per ray" of "time per ray [ms]".
std::string without_unit(const std::string& label);

/// The cells of one column for people. Doubles share one precision: four significant digits of the
/// largest, or of each if the column spans more than three decades, or two if all are below 1.
std::vector<std::string> format_column(const Table& table, std::size_t column);

/// The indices of the columns to show; all columns if `shown` is empty. Throws BadInput, with the
/// known names, for an unknown name.
std::vector<std::size_t> find_all(const Table& table, const std::vector<std::string>& shown);

/// True if a column holds only numbers and empty cells; it is then aligned to the right.
bool is_numeric(const Table& table, std::size_t column);

/// Aligned columns for a terminal: names, a rule, a line per row. `shown` as in `find_all`.
std::string to_text(const Table& table, const std::vector<std::string>& shown = {});

/// RFC 4180 with '\n' line ends, the same bytes on any machine. `parse_csv` restores the columns
/// and typed cells. A double always has a point or an exponent, or is inf or nan; ambiguous text is
/// quoted. `axes` is not written.
std::string to_csv(const Table& table);

/// The table with a ' before each text that a spreadsheet would take for a formula.
Table guard_formulas(Table table);
/// Reads the output of to_csv, and everything base::CsvReader allows. Skips blank lines, except as
/// rows of a table with one column. A quoted cell is text; a bare one is an integer, else a double,
/// else text. `axes` is 0. Throws BadInput "name:line: ...".
Table parse_csv(std::string_view text, std::string_view name);

}  // namespace laboratory
