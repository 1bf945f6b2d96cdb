#pragma once
// A statement that ends with its line: the words of a text file, one line at a time.

#include "renderer/files/tokens.hpp"

namespace radiosity {

using renderer::Vec;

/// Of the line whose first word has been taken. Errors as those of Tokens.
class Statement {
 public:
  explicit Statement(renderer::Tokens& tokens) : tokens_(tokens), line_(tokens.line()) {}

  /// The next word of the line, or empty.
  std::string_view peek() { return tokens_.continues() ? tokens_.peek() : std::string_view(); }
  /// Takes the next word if it is this one.
  bool take_if(std::string_view word);
  std::string take_word(std::string_view what);
  double take_number(std::string_view what);
  int take_count(std::string_view what, int lo, int hi);
  Vec take_vec(std::string_view what);
  renderer::Rgb take_rgb(std::string_view what);
  /// Takes the rest of the line, whatever it is.
  void skip();
  /// Nothing must follow.
  void end();

  int line() const { return line_; }
  /// "name:line: message"
  [[noreturn]] void fail(std::string_view message) const { tokens_.fail(line_, message); }
  /// Of the next word: "found ..., expected ...".
  [[noreturn]] void fail_next(std::string_view expected);

 private:
  void need(std::string_view what);

  renderer::Tokens& tokens_;
  int line_;
};

}  // namespace radiosity
