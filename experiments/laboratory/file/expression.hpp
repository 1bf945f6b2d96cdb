#pragma once
// A formula of [let], [[check]] or [[plot]]. It uses the numbers of its own row, and in braces
// those of other rows: "time_s / {time_s @ workers = 1}".
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "base/formula.hpp"

namespace laboratory {

/// {COLUMN @ AXIS = VALUE, ...}: the value of COLUMN, or of a name of [let], in another row of the
/// sweep. That row has the given values on the given axes and the own values on all others. Axes
/// coupled with a given axis in [sweep] follow it if no row has their own values too.
struct RowReference {
  struct Condition {
    std::string axis, text;                ///< VALUE as written
    std::optional<base::Formula> value{};  ///< over the own row; none if VALUE is not an
                                           ///< expression, such as mesh:4x4 on a text axis
  };
  std::string text;  ///< the whole text in braces
  std::string column;
  std::vector<Condition> conditions;
};

class Expression {
 public:
  /// Throws BadInput that begins with `place`, as base::Formula does, and for braces without a
  /// valid reference.
  Expression(const std::string& text, const std::string& place);

  const std::string& place() const { return formula_.place(); }
  /// The variables of the formula; some represent references.
  const std::vector<std::string>& variables() const { return formula_.variables(); }
  /// Null for a name of the own row.
  const RowReference* find_reference(const std::string& variable) const;
  /// All columns it names: those of its own row and those in braces.
  std::vector<std::string> names() const;
  /// Takes `values` in the order of `variables`.
  double eval(const std::vector<double>& values) const { return formula_.eval(values); }

 private:
  std::string replace_references(const std::string& text, const std::string& place);

  std::map<std::string, RowReference> references_;  // by the variable in their place
  base::Formula formula_;
};

}  // namespace laboratory
