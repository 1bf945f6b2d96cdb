#include "experiments/laboratory/table/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace laboratory {
namespace {

std::string to_shortest(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

// How to write the doubles of one column: the fmt presentation.
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
  if (largest > 1e3 * smallest || largest >= 1e9 || largest < 1e-4) return "{:.4g}";
  const int digits_before = static_cast<int>(std::floor(std::log10(largest))) + 1;
  return fmt::format("{{:.{}f}}", std::max(0, 4 - digits_before));
}

// Characters of a UTF-8 text.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](unsigned char c) { return (c & 0xc0) != 0x80; }));
}

// Control characters would break the lines, or command the terminal.
std::string make_printable(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return text;
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

Value to_cell(double value) {
  if (value == std::floor(value) && std::abs(value) < 1e15) return static_cast<std::int64_t>(value);
  return value;
}

std::string to_string(const Value& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return std::to_string(*integer);
  if (const auto* number = std::get_if<double>(&value)) return to_shortest(*number);
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return {};
}

std::string join_texts(const std::vector<std::string>& texts, std::string_view separator) {
  std::string joined;
  for (const auto& text : texts) {
    if (&text != &texts.front()) joined += separator;
    joined += text;
  }
  return joined;
}

std::string make_label(std::string_view column) {
  static constexpr std::pair<std::string_view, std::string_view> UNITS[] = {
      {"_s", "s"},           {"_ms", "ms"},         {"_us", "µs"},       {"_ns", "ns"},
      {"_hz", "Hz"},         {"_mhz", "MHz"},       {"_bytes", "bytes"}, {"_kb", "kB"},
      {"_mb", "MB"},         {"_bits", "bits"},     {"_bit_s", "bit/s"}, {"_mbit", "Mbit/s"},
      {"_mbit_s", "Mbit/s"}, {"_cycles", "cycles"}, {"_per_s", "1/s"}};
  if (column == "speedup") return "speed-up";
  if (column == "serial_karp_flatt") return "serial fraction (Karp-Flatt)";
  if (column == "serial_gustafson") return "serial fraction (Gustafson)";
  std::string_view unit, suffix;
  for (const auto& [end, name] : UNITS)
    if (column.ends_with(end) && end.size() > suffix.size() && end.size() < column.size())
      suffix = end, unit = name;
  std::string label(column.substr(0, column.size() - suffix.size()));
  std::ranges::replace(label, '_', ' ');
  return unit.empty() ? label : fmt::format("{} [{}]", label, unit);
}

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
      throw std::invalid_argument(fmt::format("no column \"{}\" in the table; its columns are {}",
                                              name, join_texts(table.columns, ", ")));
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
    std::ranges::transform(cells, cells.begin(), make_printable);
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

}  // namespace laboratory
