#pragma once
// Expressions over named numbers: "hops * (t_start + bytes / link.one_way_rate)". They offer the
// operators and functions of muParser plus floor and ceil. Only this module uses muParser.
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace base {

class Formula {
 public:
  static constexpr std::size_t MAX_BYTES = 20'000;

  /// `place` begins messages: "e.toml:12: check \"x\": formula". Names consist of letters, digits,
  /// _ and dots. Throws BadInput with the text unless it is one expression of at most MAX_BYTES.
  /// For an unknown function the message suggests the nearest name.
  Formula(const std::string& text, std::string place);
  ~Formula();
  Formula(Formula&&) noexcept;
  Formula& operator=(Formula&&) noexcept;

  const std::string& place() const { return place_; }
  /// The distinct names in the expression.
  const std::vector<std::string>& variables() const { return variables_; }
  /// Evaluates with `values` in the order of `variables`. The result may be infinite or NaN.
  double eval(std::span<const double> values) const;

  /// True if a variable may have this name.
  static bool is_name(const std::string& text);

 private:
  struct Parser;
  std::string place_;
  std::unique_ptr<Parser> parser_;
  std::vector<std::string> variables_;
};

}  // namespace base
