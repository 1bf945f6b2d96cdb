#pragma once
// Comma-separated values (RFC 4180), record by record.
#include <string>
#include <string_view>
#include <vector>

namespace base {

struct CsvCell {
  std::string text;
  bool is_quoted = false;
};

/// Reads a text, which has to outlive it. Lines that start with # are comments; blanks around bare
/// cells are dropped; "\r\n" and a byte order mark are allowed; a quoted cell may hold line ends.
/// Every error is a BadInput "name:line: ...".
class CsvReader {
 public:
  CsvReader(std::string_view text, std::string_view name);

  /// The cells of the next record, empty where the text ends; a blank line is one empty bare cell.
  std::vector<CsvCell> take();
  /// Takes records up to the first that is not blank: the names of the columns, each there once and
  /// none empty.
  std::vector<std::string> take_header();
  /// The line where the record taken last begins, from 1.
  int line() const { return record_line_; }
  /// Throws BadInput about the record taken last.
  [[noreturn]] void fail(std::string_view what) const { fail_at(record_line_, what); }

  /// The same about that line.
  [[noreturn]] void fail_at(int line, std::string_view what) const;

 private:
  bool ends_line() const { return at_ == text_.size() || text_[at_] == '\n'; }
  void skip_blanks();
  void skip_comments();
  CsvCell take_quoted();
  CsvCell take_bare();

  std::string_view text_, name_;
  std::size_t at_ = 0;
  int line_ = 1;  // the line of text_[at_]
  int record_line_ = 1;
};

/// Whether a record is a blank line.
bool is_blank(const std::vector<CsvCell>& record);

/// A text as a cell that CsvReader gives back: in quotes where it would lose something without.
std::string quote_csv(std::string_view text);

/// Cells as they stand in a line, commas between them and a line end.
std::string join_csv(const std::vector<std::string>& cells);

}  // namespace base
