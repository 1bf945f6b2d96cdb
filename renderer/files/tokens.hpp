#pragma once
// Words of a text file, with the line each was found on.

#include <istream>
#include <optional>
#include <string>
#include <string_view>

#include "renderer/scene/vec.hpp"

namespace renderer {

/// Largest magnitude of a number in a scene: products of several must stay finite.
inline constexpr double MAX_NUMBER = 1e15;

/// Reads words separated by blanks; '#' starts a comment that ends with the line. Every error is a
/// BadInput "name:line: found ..., expected ...".
class Tokens {
 public:
  Tokens(std::istream& in, std::string name) : in_(in), name_(std::move(name)) {}

  /// The next word without taking it; empty at the end of the file.
  std::string_view peek();
  /// Takes the next word; empty at the end of the file.
  std::string take();
  /// Whether the next word is on the same line as the one taken last.
  bool continues();
  /// A finite number up to MAX_NUMBER in magnitude; `what` names it in the error.
  double take_number(std::string_view what);
  /// The same, between `lo` and `hi`.
  double take_number(std::string_view what, double lo, double hi);
  int take_count(std::string_view what, int lo, int hi);
  Vec take_vec(std::string_view what);
  Rgb take_rgb(std::string_view what);

  /// Line of the word taken last.
  int line() const { return taken_line_; }
  /// "name:line: message", at a given line.
  [[noreturn]] void fail(int line, std::string_view message) const;
  /// Of the next word: "found ..., expected ...".
  [[noreturn]] void fail_next(std::string_view expected);

 private:
  std::istream& in_;
  std::string name_, text_, next_;
  std::size_t at_ = 0;
  int line_ = 0, taken_line_ = 0;
};

/// Quoted, printable and short.
std::string quote(std::string_view word);

}  // namespace renderer
