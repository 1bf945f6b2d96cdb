#pragma once
// An expression over named numbers: "hops * (t_start + bytes / link.one_way_rate)". It has the
// operators and functions of muParser, to which this is the only door, and floor and ceil.
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace base {

class Formula {
 public:
  static constexpr std::size_t MAX_BYTES = 20'000;

  /// `place` begins the messages about mistakes: "e.toml:12: check \"x\": formula". Names consist
  /// of letters, digits, _ and dots. Throws BadInput, with the text, unless it is one expression,
  /// with the nearest name for a function that does not exist, and for a text beyond MAX_BYTES.
  Formula(const std::string& text, std::string place);
  ~Formula();
  Formula(Formula&&) noexcept;
  Formula& operator=(Formula&&) noexcept;

  const std::string& place() const { return place_; }
  /// The names that it uses, each once.
  const std::vector<std::string>& variables() const { return variables_; }
  /// Takes `values` in the order of `variables`. The result may be infinite or not a number.
  double eval(std::span<const double> values) const;

  /// Whether a variable may have this name.
  static bool is_name(const std::string& text);

 private:
  struct Parser;
  std::string place_;
  std::unique_ptr<Parser> parser_;
  std::vector<std::string> variables_;
};

}  // namespace base
