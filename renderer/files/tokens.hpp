#pragma once
// Words of a text file, each with its line.

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "renderer/scene/require.hpp"
#include "renderer/scene/vec.hpp"

namespace renderer {

/// Largest magnitude of a number in a scene, so that products of several remain finite.
inline constexpr double MAX_NUMBER = 1e15;

/// Parses a finite decimal number and nothing else, whatever the locale.
std::optional<double> parse_number(std::string_view word);

/// Reads words separated by blanks from a text, which must outlive it; '#' starts a comment that
/// ends with the line. If a comment begins its line and `is_statement` accepts it, its '#' and
/// words are returned like others. Every error is a BadInput "name:line: found ..., expected ...".
class Tokens {
 public:
  using IsStatement = bool (*)(std::string_view comment);
  Tokens(std::string_view text, std::string name, IsStatement is_statement = nullptr)
      : text_(text), name_(std::move(name)), is_statement_(is_statement) {}

  /// Begins a statement that ends with its line. Until the next call no function takes words from
  /// another line. False at the end of the file. Files that never call it may break lines anywhere.
  bool begin_line();

  /// Runs `read` on the line of the word taken last: no function in it takes words from another
  /// line. The line must end after it.
  template <class Read>
  void within_line(const Read& read) {
    by_line_ = true;
    read();
    end_line();
    by_line_ = false;
  }

  /// The next word without taking it; empty at the end of the file or of the statement.
  std::string_view peek();
  /// Takes the next word; empty at the end.
  std::string_view take();
  /// Takes the next word if it is this one.
  bool take_if(std::string_view word);
  /// Skips the rest of the statement's line.
  void skip_line();
  /// Fails unless the statement ends here.
  void end_line();
  /// True if the next word is on the same line as the one taken last.
  bool continues();

  // `what` names the value in error messages.
  std::string_view take_word(std::string_view what);
  /// A finite number up to MAX_NUMBER in magnitude.
  double take_number(std::string_view what);
  /// A number from `lo` to `hi`.
  double take_number(std::string_view what, double lo, double hi);
  int take_count(std::string_view what, int lo, int hi);
  Vec take_vec(std::string_view what);
  /// Components up to MAX_NUMBER in magnitude; the range of a colour is not checked.
  Rgb take_rgb(std::string_view what);

  /// Takes the next word, which must be the name of one of the `actions`, and returns its action.
  /// `expected` lists the names.
  template <class Action, std::size_t N>
  const Action& take_choice(const std::pair<std::string_view, Action> (&actions)[N],
                            std::string_view expected) {
    for (const auto& [name, action] : actions)
      if (take_if(name)) return action;
    fail_next(expected);
  }

  /// Line of the word taken last.
  int line() const { return taken_line_; }
  const std::string& name() const { return name_; }

  /// "name:line: message".
  [[noreturn]] void fail(int line, std::string_view message) const;
  /// "found ..., expected ..." about the next word.
  [[noreturn]] void fail_next(std::string_view expected);
  /// Runs `action` and reports a BadInput from it with `line`.
  template <class Action>
  void at_line(int line, const Action& action) const {
    at_place(fmt::format("{}:{}", name_, line), action);
  }

 private:
  void fetch();

  std::string_view text_, next_;
  std::string name_;
  IsStatement is_statement_;
  std::size_t at_ = 0;
  int line_ = 1, taken_line_ = 0;
  bool by_line_ = false;
};

}  // namespace renderer
