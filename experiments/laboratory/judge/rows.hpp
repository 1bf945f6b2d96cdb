#pragma once
// What formulas find at the points of an experiment, and which rows of its results are meant.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/file/expression.hpp"
#include "experiments/laboratory/table/table.hpp"
#include "simulator/machine/model.hpp"

namespace laboratory {

/// The rows of a table of results, with what a formula may name there: columns of the results
/// ("bytes", "latency_s"; an empty cell is not a number), numbers that the file gives to keys
/// ("image.width"), numbers of the machine model ("link.one_way_rate"), and names of [let]. A
/// column of texts has a name for each text: "topology_is_line" is 1 where the text is "line", else
/// 0. In it _ stands for what no name can hold: "mesh:4x4" is topology_is_mesh_4x4. The file and
/// the table must outlive it.
class Rows {
 public:
  Rows(const ExperimentFile& file, const Table& table);
  Rows(Rows&&) = default;

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

  /// The number of a name at a row; none for a name of [let] without a value there. Throws
  /// BadInput, beginning with `place`, for an unknown name, with the nearest, and for a column of
  /// texts, with how to compare it.
  std::optional<double> get(const std::string& name, std::size_t row,
                            const std::string& place) const;

 private:
  using Numbers = std::map<std::string, double, std::less<>>;

  const Point& point_of(std::size_t row) const { return file_.points[table_.point_of(row)]; }
  /// Null where the name is no column or the cell no text.
  const std::string* find_text(const std::string& name, std::size_t row) const;
  /// The number of a column, of the model or of the file.
  std::optional<double> find_number(const std::string& name, std::size_t row) const;
  std::optional<double> compare_text(const std::string& name, std::size_t row) const;
  std::optional<std::size_t> find_row(const RowReference& reference, const std::string& place,
                                      std::size_t row) const;
  /// The row with these values on all axes, else the only one with these on the axes that are not
  /// free. Throws base::BadInput for several.
  std::optional<std::size_t> choose_row(const RowReference& reference, const std::string& place,
                                        const std::vector<Value>& wanted,
                                        const std::vector<bool>& is_free) const;

  const ExperimentFile& file_;
  const Table& table_;
  std::map<std::string, Numbers> models_;                           // by model_key
  std::vector<const Numbers*> model_of_;                            // of each row
  std::map<std::string, std::vector<std::optional<double>>> lets_;  // at each row
};

std::vector<std::string> axis_names(const Table& table);

/// The column of an axis. Throws base::BadInput, beginning with `place`, with the nearest axis.
std::size_t find_axis(const Table& table, const std::string& axis, const std::string& place);

/// The rows of points that came to their end and where the expression, if there is one, is not 0.
/// Throws base::BadInput where it is not a number.
std::vector<std::size_t> choose_rows(const Rows& rows, const std::optional<Expression>& where);

/// Numbers from elsewhere: a table of this file name, its column with the value, and the columns
/// that say which row is which point.
struct Reference {
  const Table& table;
  const std::string &name, &column;
  const std::vector<std::string>& keys;
};

/// The rows of the table that the reference has a value for, with that value: those with the same
/// keys, where texts are compared as texts and numbers as numbers. Adds a note "3 row(s) of FILE
/// were not run: objects = 400, workers = 1; ..." on values without such a row.
std::vector<std::pair<std::size_t, double>> match_reference(const Reference& reference,
                                                            const Table& table,
                                                            std::vector<std::string>& notes);

/// "2 point(s) left out, ...": these rows need other rows that are not there. None for no rows.
std::optional<std::string> note_left_out(const Table& table, const std::vector<std::size_t>& rows);

/// "objects = 200, workers = 1"
std::string name_axes(const Table& table, std::size_t row);

/// What base::suggest() says of `name`, or of its successor where it is a column that was renamed.
std::string suggest_column(const std::string& name, const std::vector<std::string>& known);

}  // namespace laboratory
