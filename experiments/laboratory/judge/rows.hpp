#pragma once
// What formulas find at the points of an experiment, and which rows of its results are meant.
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/file/expression.hpp"
#include "experiments/laboratory/table/table.hpp"
#include "simulator/machine/model.hpp"

namespace laboratory {

/// What a formula may name at one point: columns of the results ("bytes", "latency_s"), numbers
/// that the file gives to keys ("image.width"), numbers of the machine model ("link.one_way_rate"),
/// and names of [let]. A column of texts has a name for each text: "topology_is_line" is 1 where
/// the text is "line", else 0. In it _ stands for what no name can hold: "mesh:4x4" is
/// topology_is_mesh_4x4.
class Variables {
 public:
  Variables(const Point& point, const machine::Model& model);
  /// The point's row of results. An empty cell is not a number.
  void add_row(const Table& table, const std::vector<Value>& row);
  /// Throws base::BadInput, beginning with `place`, if there is one of this name.
  void add(const std::string& name, double value, const std::string& place);
  /// Throws base::BadInput, beginning with `place`, for an unknown name, with the nearest, and for
  /// a column of texts, with how to compare it.
  double get(const std::string& name, const std::string& place) const;

 private:
  std::optional<double> compare_text(const std::string& name) const;

  std::map<std::string, double, std::less<>> numbers_;
  std::map<std::string, std::string, std::less<>> texts_;
};

/// The rows of a table of results with all names that formulas may use there. The file and the
/// table must outlive it.
class Rows {
 public:
  Rows(const ExperimentFile& file, const Table& table);

  const Table& table() const { return table_; }
  /// Whether the row's point came to its end.
  bool is_complete(std::size_t row) const;

  /// Gives a name of [let] its value at every row. Throws base::BadInput for a name that there is
  /// already, and as `check` does.
  void define(const std::string& name, const Expression& expression, const std::string& place);

  /// Throws base::BadInput for names that are unknown at this row, with the nearest: variables, and
  /// columns and axes in braces.
  void check(const Expression& expression, std::size_t row) const;

  /// The value at a row; none where it needs another row that is not there or did not come to its
  /// end. Throws base::BadInput where braces speak of several rows.
  std::optional<double> eval(const Expression& expression, std::size_t row) const;

 private:
  std::optional<std::size_t> find_row(const RowReference& reference, const std::string& place,
                                      std::size_t row) const;
  /// The row with these values on all axes, else the only one with these on the axes that are not
  /// free. Throws base::BadInput for several.
  std::optional<std::size_t> choose_row(const RowReference& reference, const std::string& place,
                                        const std::vector<Value>& wanted,
                                        const std::vector<bool>& is_free) const;

  const ExperimentFile& file_;
  const Table& table_;
  std::vector<Variables> variables_;
  std::vector<std::set<std::string>> missing_;  // names of [let] without a value at each row
};

std::vector<std::string> axis_names(const Table& table);

/// The column of an axis. Throws base::BadInput, beginning with `place`, with the nearest axis.
std::size_t find_axis(const Table& table, const std::string& axis, const std::string& place);

/// The rows of points that came to their end and where the expression, if there is one, is not 0.
/// Throws base::BadInput where it is not a number.
std::vector<std::size_t> choose_rows(const Rows& rows, const std::optional<Expression>& where);

/// For each row of a reference the rows of the table with the same `keys`; texts are compared as
/// texts, numbers as numbers.
std::vector<std::vector<std::size_t>> match_rows(const Table& reference, const Table& table,
                                                 const std::vector<std::string>& keys);

/// "3 row(s) of FILE were not run: objects = 400, workers = 1; ...": the rows of a reference that
/// have a number in `column` and no match. None where there is no such row.
std::optional<std::string> note_missing(const Table& reference, const std::string& name,
                                        const std::string& column,
                                        const std::vector<std::string>& keys,
                                        const std::vector<std::vector<std::size_t>>& matches);

/// "2 point(s) left out, ...": these rows need other rows that are not there. None for no rows.
std::optional<std::string> note_left_out(const Table& table, const std::vector<std::size_t>& rows);

/// "objects = 200, workers = 1"
std::string name_axes(const Table& table, std::size_t row);

/// The name among `known` that `name` was probably meant to be: its successor, for a column that
/// has been renamed, else the nearest.
std::string nearest_column(const std::string& name, const std::vector<std::string>& known);

}  // namespace laboratory
