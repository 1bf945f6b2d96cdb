#pragma once
// A formula of [let], [[check]] or [[plot]]: over the numbers of its own row, and in braces over
// those of others: "time_s / {time_s @ workers = 1}".
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "base/formula.hpp"

namespace laboratory {

/// {COLUMN @ AXIS = VALUE, ...}: the number that COLUMN, or a name of [let], has in the row of the
/// same sweep with these values on these axes and its own on all others. Axes that go together with
/// one of these in [sweep] follow it where no row has their own values too.
struct RowReference {
  struct Condition {
    std::string axis, text;                ///< VALUE as it stands there
    std::optional<base::Formula> value{};  ///< over the own row; none for what is no expression,
                                           ///< such as mesh:4x4, the value of an axis of texts
  };
  std::string text;  ///< the whole, in braces
  std::string column;
  std::vector<Condition> conditions;
};

class Expression {
 public:
  /// Throws BadInput, beginning with `place`, as base::Formula does, and for braces that hold no
  /// reference.
  Expression(const std::string& text, const std::string& place);

  const std::string& place() const { return formula_.place(); }
  /// The variables of the formula; some stand for references.
  const std::vector<std::string>& variables() const { return formula_.variables(); }
  /// Null for a name of the own row.
  const RowReference* find_reference(const std::string& variable) const;
  /// What it names of any row: its own, and in braces.
  std::vector<std::string> names() const;
  /// Takes `values` in the order of `variables`.
  double eval(const std::vector<double>& values) const { return formula_.eval(values); }

 private:
  std::string replace_references(const std::string& text, const std::string& place);

  std::map<std::string, RowReference> references_;  // by the variable in their place
  base::Formula formula_;
};

}  // namespace laboratory
