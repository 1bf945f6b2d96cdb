#pragma once
// Reads comma-separated values (RFC 4180), record by record, and writes cells.
#include <string>
#include <string_view>
#include <vector>

namespace base {

struct CsvCell {
  std::string text;
  bool is_quoted = false;
};

/// Reads a text that must outlive the reader. Ignores lines that start with #, blanks around
/// unquoted cells and a byte order mark. Lines may end with "\r\n", and quoted cells may contain
/// line ends. Every error is a BadInput whose message starts with "name:line:".
class CsvReader {
 public:
  CsvReader(std::string_view text, std::string_view name);

  /// Returns the cells of the next record, or none at the end of the text. For a blank line,
  /// returns one empty unquoted cell.
  std::vector<CsvCell> take();
  /// Skips blank records, then returns the column names of the next record. Throws BadInput unless
  /// they are unique and not empty.
  std::vector<std::string> take_header();
  /// Line number of the first line of the record read last, counted from 1.
  int line() const { return record_line_; }
  /// Throws BadInput with the line number of the record read last.
  [[noreturn]] void fail(std::string_view what) const { fail_at(record_line_, what); }

  /// Throws BadInput with the given line number.
  [[noreturn]] void fail_at(int line, std::string_view what) const;

 private:
  bool ends_line() const { return at_ == text_.size() || text_[at_] == '\n'; }
  void skip_blanks();
  void skip_comments();
  CsvCell take_quoted();
  CsvCell take_bare();

  std::string_view text_, name_;
  std::size_t at_ = 0;
  int line_ = 1;  // line number of text_[at_]
  int record_line_ = 1;
};

/// True if the record is a blank line, for which take() returns one empty unquoted cell.
bool is_blank(const std::vector<CsvCell>& record);

/// Writes a text as one cell, quoted only if necessary. CsvReader restores the text.
std::string quote_csv(std::string_view text);

/// Joins cells with commas into one line, and adds a line end. Does not quote the cells.
std::string join_csv(const std::vector<std::string>& cells);

}  // namespace base
