#include "base/csv.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "base/errors.hpp"
#include "base/text.hpp"

namespace base {

namespace {

constexpr std::string_view MARK = "\xef\xbb\xbf";  // UTF-8 byte order mark

}  // namespace

CsvReader::CsvReader(std::string_view text, std::string_view name) : text_(text), name_(name) {
  if (text_.starts_with(MARK)) text_.remove_prefix(MARK.size());
}

void CsvReader::fail_at(int line, std::string_view what) const {
  throw BadInput(fmt::format("{}:{}: {}", name_, line, what));
}

void CsvReader::skip_blanks() {
  at_ = std::min(text_.find_first_not_of(" \t\r", at_), text_.size());
}

void CsvReader::skip_comments() {
  while (at_ < text_.size() && text_[at_] == '#') {
    at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1;
    ++line_;
  }
}

CsvCell CsvReader::take_quoted() {
  const int opened = line_;
  CsvCell cell{.text = "", .is_quoted = true};
  for (++at_; at_ < text_.size(); ++at_) {
    if (text_[at_] == '"' && !text_.substr(at_ + 1).starts_with('"')) break;
    if (text_[at_] == '"') ++at_;
    if (text_[at_] == '\n') ++line_;
    cell.text += text_[at_];
  }
  if (at_ == text_.size()) fail_at(opened, "a quote opened here is never closed");
  ++at_;
  skip_blanks();
  if (!ends_line() && text_[at_] != ',')
    fail_at(line_,
            fmt::format("'{}' after a closing quote, expected a comma or the end of the line",
                        text_[at_]));
  return cell;
}

CsvCell CsvReader::take_bare() {
  const auto end = std::min(text_.find_first_of(",\n", at_), text_.size());
  const auto bare = trim(text_.substr(at_, end - at_));
  if (bare.find('"') != bare.npos)
    fail_at(line_, fmt::format("a quote inside the cell {}, expected the whole cell in quotes, "
                               "with each quote in it doubled",
                               bare));
  at_ = end;
  return {.text = std::string(bare)};
}

std::vector<CsvCell> CsvReader::take() {
  skip_comments();
  record_line_ = line_;
  std::vector<CsvCell> cells;
  while (at_ < text_.size()) {
    skip_blanks();
    const bool is_quoted = at_ < text_.size() && text_[at_] == '"';
    cells.push_back(is_quoted ? take_quoted() : take_bare());
    const bool is_last = ends_line();
    if (at_ < text_.size()) ++at_;
    if (is_last) break;
    // A comma at the end of the text is followed by an empty last cell.
    if (at_ == text_.size()) cells.emplace_back();
  }
  ++line_;
  return cells;
}

std::vector<std::string> CsvReader::take_header() {
  auto cells = take();
  while (is_blank(cells)) cells = take();
  if (cells.empty()) fail("no header line, expected column names");
  std::vector<std::string> columns;
  for (auto& cell : cells) {
    if (cell.text.empty()) fail(fmt::format("column {} has no name", columns.size() + 1));
    if (std::ranges::find(columns, cell.text) != columns.end())
      fail(fmt::format("two columns are named \"{}\"", cell.text));
    columns.push_back(std::move(cell.text));
  }
  return columns;
}

bool is_blank(const std::vector<CsvCell>& record) {
  return record.size() == 1 && record[0].text.empty() && !record[0].is_quoted;
}

std::string quote_csv(std::string_view text) {
  const bool is_safe = !text.empty() && text.find_first_of(",\"\n\r") == text.npos &&
                       trim(text) == text && !text.starts_with('#') && !text.starts_with(MARK);
  if (is_safe) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

std::string join_csv(const std::vector<std::string>& cells) {
  return fmt::format("{}\n", fmt::join(cells, ","));
}

}  // namespace base
