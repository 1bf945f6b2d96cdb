#pragma once
// Expressions with named variables, such as "hops * (t_start + bytes / link.one_way_rate)". The
// operators and functions are those of muParser, plus floor and ceil. Only this module uses
// muParser.
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace base {

class Formula {
 public:
  static constexpr std::size_t MAX_BYTES = 20'000;

  /// Throws BadInput unless `text` is one expression of at most MAX_BYTES bytes. Names of variables
  /// consist of letters, digits, _ and dots. Every message starts with `place`, such as "e.toml:12:
  /// check \"x\": formula". For an unknown function, the message suggests the nearest name.
  Formula(const std::string& text, std::string place);
  ~Formula();
  Formula(Formula&&) noexcept;
  Formula& operator=(Formula&&) noexcept;

  const std::string& place() const { return place_; }
  /// The distinct variables of the expression.
  const std::vector<std::string>& variables() const { return variables_; }
  /// Evaluates the expression. `values` are the values of `variables()`, in the same order. The
  /// result may be infinite or NaN.
  double eval(std::span<const double> values) const;

  /// True if `text` is a valid name of a variable.
  static bool is_name(const std::string& text);

 private:
  struct Parser;
  std::string place_;
  std::unique_ptr<Parser> parser_;
  std::vector<std::string> variables_;
};

}  // namespace base
