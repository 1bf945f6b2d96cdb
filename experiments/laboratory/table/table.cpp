#include "experiments/laboratory/table/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/csv.hpp"
#include "base/errors.hpp"
#include "base/text.hpp"

namespace laboratory {
namespace {

// Chooses the number format that all floating-point numbers of a column share.
std::string choose_format(const Table& table, std::size_t column) {
  double largest = 0, smallest = INFINITY;
  for (const auto& row : table.rows) {
    const auto* number = std::get_if<double>(&row[column]);
    if (!number || !std::isfinite(*number) || *number == 0) continue;
    largest = std::max(largest, std::abs(*number));
    smallest = std::min(smallest, std::abs(*number));
  }
  if (largest == 0) return "{:.1f}";
  if (table.columns[column].ends_with('%') && largest >= 0.1 && largest < 1e5) return "{:.2f}";
  if (largest > (largest < 1 ? 1e2 : 1e3) * smallest || largest >= 1e9 || largest < 1e-4)
    return "{:.4g}";
  const int digits_before = static_cast<int>(std::floor(std::log10(largest))) + 1;
  return fmt::format("{{:.{}f}}", std::max(0, 4 - digits_before));
}

Value read_bare(std::string_view text) {
  if (text.empty()) return std::monostate{};
  if (const auto integer = base::parse_number<std::int64_t>(text)) return *integer;
  if (const auto number = base::parse_number<double>(text)) return *number;
  return std::string(text);
}

// Quotes a string for CSV if it contains special characters, or would be read back as a number.
std::string write_text(const std::string& text) {
  return read_bare(text) == Value(text) ? base::quote_csv(text) : '"' + text + '"';
}

std::string write_value(const Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return write_text(*text);
  std::string digits = to_string(value);
  const bool is_double = std::holds_alternative<double>(value);
  if (is_double && digits.find_first_not_of("-0123456789") == std::string::npos) digits += ".0";
  return digits;
}

}  // namespace

std::optional<std::size_t> Table::find(std::string_view column) const {
  const auto found = std::ranges::find(columns, column);
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
}

std::size_t Table::point_of(std::size_t row) const { return points.empty() ? row : points.at(row); }

std::size_t Table::row_of(std::size_t point) const {
  if (points.empty()) return point;
  return static_cast<std::size_t>(std::ranges::lower_bound(points, point) - points.begin());
}

std::size_t Table::count_points() const { return points.empty() ? rows.size() : points.back() + 1; }

std::optional<double> as_number(const Value& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return *integer;
  if (const auto* number = std::get_if<double>(&value)) return *number;
  return std::nullopt;
}

bool is_same(const Value& a, const Value& b) {
  const auto x = as_number(a), y = as_number(b);
  return x && y ? *x == *y : a == b;
}

Value unquote_number(const Value& value) {
  const auto* text = std::get_if<std::string>(&value);
  const auto read = text ? read_bare(base::trim(*text)) : value;
  return as_number(read) ? read : value;
}

Value to_cell(double value) {
  if (value == std::floor(value) && std::abs(value) < 1e15) return static_cast<std::int64_t>(value);
  return value;
}

std::string to_string(const Value& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return std::to_string(*integer);
  if (const auto* number = std::get_if<double>(&value)) {
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, *number).ptr};
  }
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return {};
}

std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](unsigned char c) { return (c & 0xc0) != 0x80; }));
}

std::string join_texts(const std::vector<std::string>& texts, std::string_view separator) {
  return fmt::format("{}", fmt::join(texts, separator));
}

namespace {

struct Ending {
  std::string_view ending, unit;
};

// Finds the unit at the end of a column's name; empty if the name has none.
Ending find_unit(std::string_view column) {
  static constexpr std::pair<std::string_view, std::string_view> UNITS[] = {
      {"_s", "s"},           {"_ms", "ms"},         {"_us", "µs"},       {"_ns", "ns"},
      {"_hz", "Hz"},         {"_mhz", "MHz"},       {"_bytes", "bytes"}, {"_kb", "kB"},
      {"_mb", "MB"},         {"_bits", "bits"},     {"_bit_s", "bit/s"}, {"_mbit", "Mbit/s"},
      {"_mbit_s", "Mbit/s"}, {"_cycles", "cycles"}, {"_per_s", "1/s"},   {"_Bps", "bytes/s"}};
  Ending found;
  for (const auto& [end, unit] : UNITS)
    if (column.ends_with(end) && end.size() > found.ending.size() && end.size() < column.size())
      found = {end, unit};
  return found;
}

}  // namespace

std::string unit_of(std::string_view column) { return std::string(find_unit(column).unit); }

std::string make_label(std::string_view column) {
  // the name of a column with half widths of confidence intervals ends with this text
  constexpr std::string_view HALF_WIDTH = " ±";
  if (column.ends_with(HALF_WIDTH))
    return make_label(column.substr(0, column.size() - HALF_WIDTH.size())) +
           std::string(HALF_WIDTH);
  if (column == "speedup") return "speed-up";
  if (column == "serial_karp_flatt") return "serial fraction (Karp-Flatt)";
  if (column == "serial_gustafson") return "serial fraction (Gustafson)";
  const auto [ending, unit] = find_unit(column);
  std::string label(column.substr(0, column.size() - ending.size()));
  std::ranges::replace(label, '_', ' ');
  return unit.empty() ? label : fmt::format("{} [{}]", label, unit);
}

std::string without_unit(const std::string& label) { return label.substr(0, label.rfind(" [")); }

std::vector<std::string> format_column(const Table& table, std::size_t column) {
  const std::string format = choose_format(table, column);
  std::vector<std::string> cells;
  for (const auto& row : table.rows) {
    const auto* number = std::get_if<double>(&row.at(column));
    cells.push_back(number ? fmt::format(fmt::runtime(format), *number) : to_string(row[column]));
  }
  return cells;
}

std::vector<std::size_t> find_all(const Table& table, const std::vector<std::string>& shown) {
  std::vector<std::size_t> indices(table.columns.size());
  std::iota(indices.begin(), indices.end(), 0);
  if (shown.empty()) return indices;
  indices.clear();
  for (const auto& name : shown) {
    const auto index = table.find(name);
    if (!index)
      throw base::BadInput(fmt::format("no column \"{}\" in the table; its columns are {}", name,
                                       join_texts(table.columns, ", ")));
    indices.push_back(*index);
  }
  return indices;
}

bool is_numeric(const Table& table, std::size_t column) {
  bool has_number = false;
  for (const auto& row : table.rows) {
    if (std::holds_alternative<std::string>(row.at(column))) return false;
    has_number |= as_number(row[column]).has_value();
  }
  return has_number;
}

std::string to_text(const Table& table, const std::vector<std::string>& shown) {
  std::vector<std::string> lines(table.rows.size() + 2);
  std::string gap;
  for (const std::size_t column : find_all(table, shown)) {
    auto cells = format_column(table, column);
    cells.insert(cells.begin(), table.columns[column]);
    for (auto& cell : cells) cell = base::blank_controls(cell, '?');
    const std::size_t width = width_of(std::ranges::max(cells, {}, width_of));
    cells.insert(cells.begin() + 1, std::string(width, '-'));
    const bool to_right = is_numeric(table, column);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const std::string blanks(width - width_of(cells[i]), ' ');
      lines[i] += gap + (to_right ? blanks + cells[i] : cells[i] + blanks);
    }
    gap = "  ";
  }
  std::string text;
  for (auto& line : lines) {
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

std::string to_csv(const Table& table) {
  std::vector<std::string> cells(table.columns.size());
  std::ranges::transform(table.columns, cells.begin(), write_text);
  std::string text = base::join_csv(cells);
  for (const auto& row : table.rows) {
    base::check_equal("cells of a table's row", row.size(), table.columns.size());
    std::ranges::transform(row, cells.begin(), write_value);
    text += base::join_csv(cells);
  }
  return text;
}

Table guard_formulas(Table table) {
  const auto guard = [](std::string& text) {
    if (!text.empty() && std::string_view("=+-@\t\r").find(text[0]) != std::string_view::npos)
      text.insert(0, 1, '\'');
  };
  for (auto& row : table.rows)
    for (auto& cell : row)
      if (auto* text = std::get_if<std::string>(&cell)) guard(*text);
  return table;
}

Table parse_csv(std::string_view text, std::string_view name) {
  base::CsvReader reader(text, name);
  Table table{.columns = reader.take_header(), .rows = {}};
  for (auto cells = reader.take(); !cells.empty(); cells = reader.take()) {
    if (base::is_blank(cells) && table.columns.size() > 1) continue;
    if (cells.size() != table.columns.size())
      reader.fail(fmt::format("{} cells, expected {}: {}", cells.size(), table.columns.size(),
                              fmt::join(table.columns, ",")));
    table.lines.push_back(reader.line());
    auto& row = table.rows.emplace_back();
    for (auto& cell : cells)
      row.push_back(cell.is_quoted ? Value(std::move(cell.text)) : read_bare(cell.text));
  }
  return table;
}

}  // namespace laboratory
