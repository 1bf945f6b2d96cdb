#pragma once
// Tokens of the DOT language, divided as Graphviz does.

#include <string>
#include <string_view>

namespace topologies {

struct DotToken {
  /// A word is an unquoted name or number; a string is quoted or HTML. Keywords are in lower case.
  enum class Kind { end, symbol, keyword, word, string };
  Kind kind = Kind::end;
  std::string text;  ///< without quotes; escaped quotes and line ends are resolved
  int line = 1;      ///< line of the first character, counted from 1
};

/// Reads tokens one by one; skips white space, comments and a byte-order mark.
class DotTokens {
 public:
  /// The text must outlive the object. `file` names the text in error messages.
  DotTokens(std::string_view text, std::string file);

  /// The next token, without taking it. At the end of the text, its kind is `end`.
  const DotToken& peek() const { return next_; }
  /// Takes and returns the next token. Throws BadInput for a character that starts no token, for a
  /// string, HTML text or comment without an end, and for a number followed directly by a letter.
  DotToken take();

  /// True if the next token is this symbol or keyword.
  bool sees(std::string_view text) const;
  /// Takes the next token if it is this symbol or keyword.
  bool accept(std::string_view text);
  /// Takes the next token if it is this symbol or keyword; otherwise throws BadInput.
  void require(std::string_view text);
  /// Throws BadInput with the file, the line, the next token and what was expected.
  [[noreturn]] void refuse(std::string_view expected) const;

  const std::string& file() const { return file_; }

 private:
  DotToken read();
  void skip_gaps();
  DotToken read_number();
  DotToken read_quoted();
  DotToken read_html();
  [[noreturn]] void refuse_at(int line, const std::string& message) const;
  void skip(std::size_t length);
  /// Skips the text up to and including `end`. If `end` is missing, throws BadInput that names
  /// `what` and the line where it began.
  void skip_past(std::string_view end, std::string_view what);
  std::string_view rest() const { return text_.substr(at_); }

  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
  int line_ = 1;
  DotToken next_;
};

/// True if this unquoted word, in upper or lower case, is a keyword of DOT.
bool is_dot_keyword(std::string_view word);

}  // namespace topologies
