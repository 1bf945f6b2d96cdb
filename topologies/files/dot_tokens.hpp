#pragma once
// Tokens of the DOT language, split as Graphviz splits them.

#include <string>
#include <string_view>

namespace topologies {

struct DotToken {
  /// A word is a bare name or number; a string is quoted or HTML. Keywords are in lower case.
  enum class Kind { end, symbol, keyword, word, string };
  Kind kind = Kind::end;
  std::string text;  ///< without quotes; escaped quotes and line ends are resolved
  int line = 1;      ///< of its first character, from 1
};

/// Reads tokens one by one; skips white space, comments and a byte-order mark.
class DotTokens {
 public:
  /// `file` is for messages. The text must outlive the object.
  DotTokens(std::string_view text, std::string file);

  /// The next token. It is of kind `end` at the end of the text.
  const DotToken& peek() const { return next_; }
  /// Returns the next token and reads on. Throws BadInput for characters that start no token, for
  /// unterminated strings, HTML and comments, and for a number with a letter after it.
  DotToken take();

  /// True if the next token is this symbol or keyword.
  bool sees(std::string_view text) const;
  /// Takes the next token if it is this symbol or keyword.
  bool accept(std::string_view text);
  /// Takes this symbol or keyword, or throws BadInput.
  void require(std::string_view text);
  /// Throws BadInput with file, line and the next token.
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
  /// Skips past `end`. Refuses a text without `end`: the message names `what` and its first line.
  void skip_past(std::string_view end, std::string_view what);
  std::string_view rest() const { return text_.substr(at_); }

  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
  int line_ = 1;
  DotToken next_;
};

/// True if DOT reserves this bare word, in upper or lower case.
bool is_dot_keyword(std::string_view word);

}  // namespace topologies
