#pragma once
// What formulas find at every point of an experiment.
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "experiments/laboratory/file/expression.hpp"
#include "experiments/laboratory/judge/variables.hpp"

namespace laboratory {

// The table of results with the names that its file and its models add; each row is of a point. The
// file and the table must outlive it.
class Rows {
 public:
  Rows(const ExperimentFile& file, const Table& table);

  const Table& table() const { return table_; }
  // Whether the row's point came to its end.
  bool is_complete(std::size_t row) const;

  // Gives a name of [let] its value at every row. Throws base::BadInput for one that there
  // is already, and as `check` does.
  void define(const std::string& name, const Expression& expression, const std::string& place);

  // Throws base::BadInput for names that are unknown at this row: variables, the columns and
  // axes in braces; each with the nearest.
  void check(const Expression& expression, std::size_t row) const;

  // None where it needs another row that is not there, or did not come to its end. Throws
  // base::BadInput where several rows are what braces speak of.
  std::optional<double> eval(const Expression& expression, std::size_t row) const;

 private:
  std::optional<std::size_t> find_row(const RowReference& reference, const std::string& place,
                                      std::size_t row) const;
  // Of these values on all axes, else the only one of these on those that are not free. Throws
  // base::BadInput for several.
  std::optional<std::size_t> choose_row(const RowReference& reference, const std::string& place,
                                        const std::vector<Value>& wanted,
                                        const std::vector<bool>& is_free) const;
  std::size_t find_axis(const RowReference& reference, const std::string& axis,
                        const std::string& place) const;

  const ExperimentFile& file_;
  const Table& table_;
  std::vector<Variables> variables_;
  std::vector<std::set<std::string>> missing_;  // names of [let] without a value, of each row
};

}  // namespace laboratory
