#pragma once
// Evaluation of expressions in rows of the results table, and selection of rows.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/file/expression.hpp"
#include "experiments/laboratory/table/table.hpp"
#include "simulator/machine/model.hpp"

namespace laboratory {

/// Rows of a results table, with the names that expressions may use:
///   - columns of the results ("bytes", "latency_s"); an empty cell is NaN;
///   - numbers that the file assigns to keys ("image.width");
///   - numbers of the machine model ("link.one_way_rate");
///   - names of [let].
/// Each string in a column of strings also defines a name: "topology_is_line" is 1 in rows where
/// the column `topology` has the string "line", else 0. Characters other than letters and digits
/// become _, as in topology_is_mesh_4x4 for "mesh:4x4" and topology_is_my_net_dot for "my-net.dot".
/// The file and the table must outlive the object.
class Rows {
 public:
  Rows(const ExperimentFile& file, const Table& table);
  Rows(Rows&&) = default;

  const Table& table() const { return table_; }
  /// True if the row's point was completed.
  bool is_complete(std::size_t row) const;

  /// Defines a name of [let], and evaluates its expression in every row. Throws base::BadInput if
  /// the name exists, and as check() does.
  void define(const std::string& name, const Expression& expression, const std::string& place);

  /// Throws base::BadInput, with the nearest valid name, if the expression uses an unknown name: a
  /// variable, or a column or axis in braces.
  void check(const Expression& expression, std::size_t row) const;

  /// Evaluates an expression in a row. No value if it refers to a missing or incomplete row, or is
  /// NaN because of an empty cell. Throws base::BadInput if a reference in braces matches several
  /// rows.
  std::optional<double> eval(const Expression& expression, std::size_t row) const;

  /// The number that a name stands for in a row; no value for a name of [let] that has no value in
  /// this row. Throws BadInput with the prefix `place` for an unknown name or a column of strings.
  /// The message gives the nearest valid name, or explains how to compare a column of strings.
  std::optional<double> get(const std::string& name, std::size_t row,
                            const std::string& place) const;

 private:
  using Numbers = std::map<std::string, double, std::less<>>;
  struct Evaluated {
    std::optional<double> value = {};  // no value if the expression refers to a missing row
    bool is_gap = false;               // true if the value is NaN because of an empty cell
  };

  const Point& point_of(std::size_t row) const { return file_.points[table_.point_of(row)]; }
  /// The string in a column; null if the name is not a column or the cell is not a string.
  const std::string* find_text(const std::string& name, std::size_t row) const;
  /// The number of a column, of the machine model or of the experiment file.
  std::optional<double> find_number(const std::string& name, std::size_t row) const;
  std::optional<double> compare_text(const std::string& name, std::size_t row) const;
  Evaluated eval_at(const Expression& expression, std::size_t row) const;
  /// True if the name is a column whose cell is empty in this row, or a name of [let] whose value
  /// is NaN because of an empty cell.
  bool is_gap(const std::string& name, std::size_t row) const;
  std::optional<std::size_t> find_row(const RowReference& reference, const std::string& place,
                                      std::size_t row) const;
  /// Finds the row with the wanted values on all axes. If there is none, finds the only row with
  /// the wanted values on all axes that are not free. Throws base::BadInput if several rows have
  /// these values.
  std::optional<std::size_t> choose_row(const RowReference& reference, const std::string& place,
                                        const std::vector<Value>& wanted,
                                        const std::vector<bool>& is_free) const;

  const ExperimentFile& file_;
  const Table& table_;
  // numeric entries of each machine model, by the model's key
  std::map<std::string, Numbers> models_;
  std::vector<const Numbers*> model_of_;  // for each row, the entries of its machine model
  // names of [let], with their values by row
  std::map<std::string, std::vector<Evaluated>> lets_;
};

std::vector<std::string> axis_names(const Table& table);
/// The first function lists the axes with several values, except seeds. Rows that agree on these
/// axes are samples of one point. The second function returns the values of these axes in a row,
/// and the third returns them as text: "objects = 200, workers = 1".
std::vector<std::string> sampled_axis_names(const Table& table);
std::vector<Value> take_sampled_axes(const Table& table, std::size_t row);
std::string name_sampled_axes(const Table& table, std::size_t row);

/// The number of an axis's column. Throws base::BadInput with the prefix `place` and the nearest
/// name if there is no such axis.
std::size_t find_axis(const Table& table, const std::string& axis, const std::string& place);

/// The rows of completed points in which the expression is not 0; without an expression, the rows
/// of all completed points. Leaves out rows in which the expression has no value. Throws
/// base::BadInput if the value is not a number.
std::vector<std::size_t> choose_rows(const Rows& rows, const std::optional<Expression>& where);

/// Reference values: their table, the file it was read from, the column with the values, and the
/// columns that identify a point.
struct Reference {
  const Table& table;
  const std::string &name, &column;
  const std::vector<std::string>& keys;
};

/// Finds the row for each reference value: the row in which the key columns have the same values.
/// Numbers are compared as numbers, strings as strings. Adds a note about reference values without
/// a row: "3 row(s) of FILE were not run: objects = 400, workers = 1; ...".
std::vector<std::pair<std::size_t, double>> match_reference(const Reference& reference,
                                                            const Table& table,
                                                            std::vector<std::string>& notes);

/// Makes a note about rows that are left out because their expressions refer to missing rows or
/// empty cells: "2 point(s) left out, ...". No value if there are no such rows.
std::optional<std::string> note_left_out(const Table& table, const std::vector<std::size_t>& rows);

/// The name that compares a column with a string: "topology_is_mesh_4x4".
std::string name_comparison(const std::string& column, const std::string& text);

/// Formats the axes of a row: "objects = 200, workers = 1".
std::string name_axes(const Table& table, std::size_t row);

/// Suggests a valid name as base::suggest() does. For the former name of a renamed column, suggests
/// the present name.
std::string suggest_column(const std::string& name, const std::vector<std::string>& known);

}  // namespace laboratory
