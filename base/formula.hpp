#pragma once
// An expression over named numbers: "hops * (t_start + bytes / link.one_way_rate)". The only door
// to muParser, whose operators and functions it knows, and floor and ceil.
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace base {

class Formula {
 public:
  // `place` begins what is said about mistakes: "e.toml:12: check \"x\": formula". Names are of
  // letters, digits, _ and dots. Throws BadInput for what is no single expression,
  // with the text, and for a function that does not exist, with the nearest.
  Formula(const std::string& text, std::string place);
  ~Formula();
  Formula(Formula&&) noexcept;
  Formula& operator=(Formula&&) noexcept;

  const std::string& place() const { return place_; }
  // The names it uses, each once.
  const std::vector<std::string>& variables() const { return variables_; }
  // `values` in the order of `variables`. May be infinite or not a number.
  double eval(std::span<const double> values) const;

  // Whether a variable may be called that.
  static bool is_name(const std::string& text);

 private:
  struct Parser;
  std::string place_;
  std::unique_ptr<Parser> parser_;
  std::vector<std::string> variables_;
};

}  // namespace base
