#pragma once
// Evaluation of formulas at the points of an experiment, and selection of rows of its results.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/file/expression.hpp"
#include "experiments/laboratory/table/table.hpp"
#include "simulator/machine/model.hpp"

namespace laboratory {

/// The rows of a table of results with the names that formulas may use. These are columns of the
/// results ("bytes", "latency_s"; an empty cell is not a number), numbers that the file assigns to
/// keys ("image.width"), numbers of the machine model ("link.one_way_rate"), and names of [let]. A
/// column of texts has a name for each text: "topology_is_line" is 1 if the text is "line", else 0.
/// Other characters become _, as in topology_is_mesh_4x4 for "mesh:4x4". The file and the table
/// must outlive it.
class Rows {
 public:
  Rows(const ExperimentFile& file, const Table& table);
  Rows(Rows&&) = default;

  const Table& table() const { return table_; }
  /// True if the row's point was completed.
  bool is_complete(std::size_t row) const;

  /// Sets a name of [let] to its value at every row. Throws base::BadInput for an existing name,
  /// and as `check` does.
  void define(const std::string& name, const Expression& expression, const std::string& place);

  /// Throws base::BadInput for unknown names at this row, with the nearest: variables, and columns
  /// and axes in braces.
  void check(const Expression& expression, std::size_t row) const;

  /// The value at a row; none if it needs a missing or incomplete row. Throws base::BadInput for
  /// braces that match several rows.
  std::optional<double> eval(const Expression& expression, std::size_t row) const;

  /// The number of a name at a row; none for a name of [let] without a value there. Throws
  /// BadInput, beginning with `place`, for an unknown name (with the nearest) and for a column of
  /// texts (with a hint how to compare it).
  std::optional<double> get(const std::string& name, std::size_t row,
                            const std::string& place) const;

 private:
  using Numbers = std::map<std::string, double, std::less<>>;

  const Point& point_of(std::size_t row) const { return file_.points[table_.point_of(row)]; }
  /// Null if the name is not a column or the cell not a text.
  const std::string* find_text(const std::string& name, std::size_t row) const;
  /// The number of a column, of the model or of the file.
  std::optional<double> find_number(const std::string& name, std::size_t row) const;
  std::optional<double> compare_text(const std::string& name, std::size_t row) const;
  std::optional<std::size_t> find_row(const RowReference& reference, const std::string& place,
                                      std::size_t row) const;
  /// The row with these values on all axes, or else the only row with these values on the axes that
  /// are not free. Throws base::BadInput for several.
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

/// The column of an axis. For an unknown axis throws base::BadInput, whose message begins with
/// `place` and suggests the most similar name.
std::size_t find_axis(const Table& table, const std::string& axis, const std::string& place);

/// The rows of completed points with a non-zero value of the expression, or all of them without
/// one. Throws base::BadInput if the value is not a number.
std::vector<std::size_t> choose_rows(const Rows& rows, const std::optional<Expression>& where);

/// Reference numbers: a table read from this file name, its column of values, and its columns that
/// identify the point.
struct Reference {
  const Table& table;
  const std::string &name, &column;
  const std::vector<std::string>& keys;
};

/// Pairs of a row and its reference value, matched by equal keys: texts compared as texts, numbers
/// as numbers. Adds a note about reference values without a row, "3 row(s) of FILE were not run:
/// objects = 400, workers = 1; ...".
std::vector<std::pair<std::size_t, double>> match_reference(const Reference& reference,
                                                            const Table& table,
                                                            std::vector<std::string>& notes);

/// "2 point(s) left out, ...": these rows need missing rows. None for no rows.
std::optional<std::string> note_left_out(const Table& table, const std::vector<std::size_t>& rows);

/// "objects = 200, workers = 1"
std::string name_axes(const Table& table, std::size_t row);

/// The suggestion of base::suggest() for `name`, or the successor of a renamed column.
std::string suggest_column(const std::string& name, const std::vector<std::string>& known);

}  // namespace laboratory
