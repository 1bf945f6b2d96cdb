#pragma once
// Splits text files into words and keeps track of line numbers.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "renderer/scene/require.hpp"
#include "renderer/scene/vec.hpp"

namespace renderer {

/// Largest magnitude of a number in a scene. Products of several such numbers stay finite.
inline constexpr double MAX_NUMBER = 1e15;

/// Parses a finite decimal number, independent of the locale. Returns none for any other word. The
/// exponent may be in Fortran's notation, such as 1.0D+00.
std::optional<double> parse_number(std::string_view word);

/// Reads words separated by blanks from a text, which must outlive the object. '#' starts a comment
/// that ends with the line. A comment at the start of a line is a statement if `is_statement`
/// accepts it; its '#' and its words are then returned like other words. Lines end with LF, CR LF
/// or CR. UTF-8 byte order marks are skipped, and so are byte 26 and zero bytes at the end of the
/// text. Every error is a BadInput "name:line: found ..., expected ...".
class Tokens {
 public:
  using IsStatement = bool (*)(std::string_view comment);
  /// Whether a backslash at the end of a line, outside comments, joins the next line to this one.
  enum class Lines : std::uint8_t { separate, joined };
  /// `name` is the file's name in messages. Throws BadInput if the text is UTF-16.
  Tokens(std::string_view text, std::string name, IsStatement is_statement = nullptr,
         Lines lines = Lines::separate);

  /// Begins a statement that ends with its line. Until the next call, only words of this line are
  /// returned. Returns false at the end of the file. For a reader that never calls this function,
  /// line ends are blanks.
  bool begin_line();

  /// Calls `read` for the current line. `read` can take only words of this line, and must take all
  /// of them.
  template <class Read>
  void within_line(const Read& read) {
    by_line_ = true;
    read();
    end_line();
    by_line_ = false;
  }

  /// Returns the next word without taking it; "" at the end of the file or statement.
  std::string_view peek();
  /// Takes and returns the next word; "" at the end of the file or statement.
  std::string_view take();
  /// Takes the next word if it equals `word`. Returns true if it did.
  bool take_if(std::string_view word);
  /// Takes the rest of the current statement's line, including any '#', and trims it. Must be
  /// called directly after take(). A backslash joins lines only if a blank precedes it, because
  /// names of Windows folders may end with a backslash.
  std::string take_rest();
  /// Skips the rest of the current statement's line.
  void skip_line();
  /// Throws BadInput unless all words of the current statement have been taken.
  void end_line();
  /// True if the next word is on the same line as the word taken last.
  bool continues();

  // Takes a word that must exist. `what` names the value in error messages.
  std::string_view take_word(std::string_view what);
  /// Takes a finite number up to MAX_NUMBER in magnitude.
  double take_number(std::string_view what);
  /// Takes a number from `lo` to `hi`.
  double take_number(std::string_view what, double lo, double hi);
  int take_count(std::string_view what, int lo, int hi);
  Vec take_vec(std::string_view what);
  /// Takes the three components of a colour, each up to MAX_NUMBER in magnitude. The caller must
  /// check the range of the colour.
  Rgb take_rgb(std::string_view what);

  /// Takes the next word and returns the action with that name. Throws BadInput if `actions` has
  /// none; `expected` lists the valid names for the message.
  template <class Action, std::size_t N>
  const Action& take_choice(const std::pair<std::string_view, Action> (&actions)[N],
                            std::string_view expected) {
    for (const auto& [name, action] : actions)
      if (take_if(name)) return action;
    fail_next(expected);
  }

  /// The line of the last word taken, counted from 1.
  int line() const { return taken_line_; }
  const std::string& name() const { return name_; }

  /// Throws BadInput "name:line: message".
  [[noreturn]] void fail(int line, std::string_view message) const;
  /// Throws BadInput "name:line: found ..., expected ..." about the next word.
  [[noreturn]] void fail_next(std::string_view expected);
  /// Calls `action`. If it throws BadInput, puts the file's name and `line` before the message.
  template <class Action>
  void at_line(int line, const Action& action) const {
    at_place(fmt::format("{}:{}", name_, line), action);
  }

 private:
  void fetch();
  std::size_t skip_line_end(std::size_t at) const;
  std::size_t find_join(std::size_t at) const;
  void join_line(std::size_t next);
  std::size_t find_word_end() const;

  std::string_view text_, next_;
  std::string name_;
  IsStatement is_statement_;
  Lines lines_;
  std::size_t at_ = 0;
  int line_ = 1, taken_line_ = 0;
  bool by_line_ = false;
};

}  // namespace renderer
