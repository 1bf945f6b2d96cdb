// Tables as comma-separated values, both ways.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

#include "experiments/laboratory/table/table.hpp"

namespace laboratory {
namespace {

constexpr std::string_view BLANKS = " \t\r";

struct Cell {
  std::string text;
  bool is_quoted = false;
};

template <typename Number>
std::optional<Value> read_number(std::string_view text) {
  Number number{};
  const auto end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end) return std::nullopt;
  return number;
}

Value read_bare(std::string_view text) {
  if (text.empty()) return std::monostate{};
  if (const auto integer = read_number<std::int64_t>(text)) return *integer;
  if (const auto number = read_number<double>(text)) return *number;
  return std::string(text);
}

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(BLANKS);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(BLANKS) + 1 - first);
}

std::string write_text(const std::string& text) {
  const bool is_safe = text.find_first_of(",\"\n\r") == std::string::npos && trim(text) == text &&
                       !text.starts_with('#') && read_bare(text) == Value(text);
  if (is_safe) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string write_value(const Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return write_text(*text);
  std::string digits = to_string(value);
  const bool is_double = std::holds_alternative<double>(value);
  if (is_double && digits.find_first_not_of("-0123456789") == std::string::npos) digits += ".0";
  return digits;
}

// What is left of a text, taken record by record.
struct Records {
  std::string_view text, name;
  std::size_t at = 0;
  int line = 1;         // of text[at]
  int record_line = 1;  // where the last record began

  [[noreturn]] void fail(int where, const std::string& what) const {
    throw std::invalid_argument(fmt::format("{}:{}: {}", name, where, what));
  }

  bool ends_line() const { return at == text.size() || text[at] == '\n'; }

  void skip_blanks() {
    while (at < text.size() && BLANKS.find(text[at]) != std::string_view::npos) ++at;
  }

  void skip_comments() {
    while (at < text.size() && text[at] == '#') {
      at = std::min(text.find('\n', at), text.size() - 1) + 1;
      ++line;
    }
  }

  Cell take_quoted() {
    const int opened = line;
    Cell cell{.text = "", .is_quoted = true};
    for (++at; at < text.size(); ++at) {
      if (text[at] == '"' && !text.substr(at + 1).starts_with('"')) break;
      if (text[at] == '"') ++at;
      if (text[at] == '\n') ++line;
      cell.text += text[at];
    }
    if (at == text.size()) fail(opened, "a quote opened here is never closed");
    ++at;
    skip_blanks();
    if (!ends_line() && text[at] != ',')
      fail(line,
           fmt::format("'{}' after a closing quote, expected a comma or the line's end", text[at]));
    return cell;
  }

  Cell take_bare() {
    const auto end = std::min(text.find_first_of(",\n", at), text.size());
    const auto bare = trim(text.substr(at, end - at));
    if (bare.find('"') != std::string_view::npos)
      fail(line,
           fmt::format("a quote inside the cell {}, expected the whole cell in quotes, quotes "
                       "in it doubled",
                       bare));
    at = end;
    return {.text = std::string(bare)};
  }

  // Empty where the text ends.
  std::vector<Cell> take() {
    skip_comments();
    record_line = line;
    std::vector<Cell> cells;
    while (at < text.size()) {
      skip_blanks();
      const bool is_quoted = at < text.size() && text[at] == '"';
      cells.push_back(is_quoted ? take_quoted() : take_bare());
      const bool is_last = ends_line();
      if (at < text.size()) ++at;
      if (is_last) break;
      if (at == text.size()) cells.emplace_back();  // after a comma
    }
    ++line;
    return cells;
  }
};

bool is_blank(const std::vector<Cell>& cells) {
  return cells.size() == 1 && cells[0].text.empty() && !cells[0].is_quoted;
}

std::vector<std::string> take_header(Records& records) {
  auto cells = records.take();
  while (is_blank(cells)) cells = records.take();
  if (cells.empty()) records.fail(records.record_line, "no header line, expected column names");
  std::vector<std::string> columns;
  std::set<std::string> known;
  for (auto& cell : cells) {
    if (cell.text.empty())
      records.fail(records.record_line, fmt::format("column {} has no name", columns.size() + 1));
    if (!known.insert(cell.text).second)
      records.fail(records.record_line, fmt::format("two columns are named \"{}\"", cell.text));
    columns.push_back(std::move(cell.text));
  }
  return columns;
}

}  // namespace

std::string to_csv(const Table& table) {
  std::vector<std::string> cells;
  std::ranges::transform(table.columns, std::back_inserter(cells), write_text);
  std::string text = fmt::format("{}\n", join_texts(cells, ","));
  for (const auto& row : table.rows) {
    if (row.size() != table.columns.size())
      throw std::logic_error(
          fmt::format("a table's row has {} cells, expected {}", row.size(), table.columns.size()));
    std::ranges::transform(row, cells.begin(), write_value);
    text += fmt::format("{}\n", join_texts(cells, ","));
  }
  return text;
}

Table parse_csv(std::string_view text, std::string_view name) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  Records records{.text = text, .name = name};
  Table table;
  table.columns = take_header(records);
  for (auto cells = records.take(); !cells.empty(); cells = records.take()) {
    if (is_blank(cells) && table.columns.size() > 1) continue;
    if (cells.size() != table.columns.size())
      records.fail(records.record_line,
                   fmt::format("{} cells, expected {}: {}", cells.size(), table.columns.size(),
                               join_texts(table.columns, ",")));
    auto& row = table.rows.emplace_back();
    for (auto& cell : cells)
      row.push_back(cell.is_quoted ? Value(std::move(cell.text)) : read_bare(cell.text));
  }
  return table;
}

}  // namespace laboratory
