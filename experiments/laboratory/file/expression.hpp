#pragma once
// Expressions in [let], [[check]] and [[plot]]. They are evaluated for each row of the results
// table, and use columns of that row and, in braces, of other rows: "time_s / {time_s @ workers =
// 1}".
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "base/formula.hpp"

namespace laboratory {

/// A reference to another row of the sweep: {COLUMN @ AXIS = VALUE, ...}. Its value is that of
/// COLUMN (a column or a name from [let]) in the other row. The other row has the given values on
/// the given axes, and on all other axes the values of the row for which the expression is
/// evaluated. If no such row exists, axes that change together with a given axis may have any
/// value.
struct RowReference {
  struct Condition {
    std::string axis, text;  ///< name of an axis, and the text of its VALUE
    /// VALUE as an expression over the row being evaluated; none if it is a string such as mesh:4x4
    std::optional<base::Formula> value{};
  };
  std::string text;  ///< text of the reference, with its braces
  std::string column;
  std::vector<Condition> conditions;
};

class Expression {
 public:
  /// Parses an expression. Throws BadInput, with the prefix `place`, for text that base::Formula
  /// refuses, and for braces that contain no valid reference.
  Expression(const std::string& text, const std::string& place);

  const std::string& place() const { return formula_.place(); }
  /// The variables of the formula. Some of them stand for references to other rows.
  const std::vector<std::string>& variables() const { return formula_.variables(); }
  /// Returns the reference that a variable stands for; null if the variable is a column of the same
  /// row.
  const RowReference* find_reference(const std::string& variable) const;
  /// The names of all columns that the expression uses, in its own row and in other rows.
  std::vector<std::string> names() const;
  /// Evaluates the formula. `values` are in the order of `variables`.
  double eval(const std::vector<double>& values) const { return formula_.eval(values); }

 private:
  std::string replace_references(const std::string& text, const std::string& place);

  // References to other rows, by the variables that stand for them.
  std::map<std::string, RowReference> references_;
  base::Formula formula_;
};

}  // namespace laboratory
