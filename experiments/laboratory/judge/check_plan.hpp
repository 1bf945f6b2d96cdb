#pragma once
// The checks and figures of an experiment, read and compiled: everything that can be wrong with
// them before anything runs has been found.
#include <optional>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/file/expression.hpp"
#include "experiments/laboratory/judge/rows.hpp"
#include "experiments/laboratory/points/points.hpp"
#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

struct CheckPlan {
  struct Let {
    Definition definition;
    Expression formula;
  };
  struct Comparison {
    Check check;
    std::optional<Expression> of = {};  // where it is a name of [let], no column
    std::optional<Expression> formula = {}, where = {}, calibrated = {};
    std::optional<Table> reference = {};
  };
  struct Figure {
    PlotSpec spec;
    Expression x;
    std::vector<Expression> y;
    std::optional<Expression> where = {}, growth = {};
    std::optional<Table> reference = {};
  };
  struct Question {
    BestSpec spec;
    Expression of;
    std::optional<Expression> where = {};
  };
  std::vector<Let> lets;  // each after those it names
  std::vector<Comparison> comparisons;
  std::vector<Figure> figures;      // [[plot]]
  std::vector<Question> questions;  // [[best]]

  bool is_empty() const { return comparisons.empty() && figures.empty() && questions.empty(); }
};

// Throws base::BadInput for what is no expression, for definitions that need each other, for
// names with a dot that no point knows, and for a reference that cannot be read. Names without a
// dot may be columns, which are not known yet.
CheckPlan plan_checks(const ExperimentFile& file);

// What all formulas of a plan may name: every row, with the definitions. The file and the table
// must outlive it.
Rows make_rows(const CheckPlan& plan, const ExperimentFile& file, const Table& table);

// Throws base::BadInput for names in the plan that are unknown at a point with this row.
void check_names(const CheckPlan& plan, const ExperimentFile& file, std::size_t point,
                 const Table& table, const std::vector<Value>& row);

// The same of a point that has come to its end, as soon as it has: what PointsPlan calls. The plan
// and the file must outlive it.
Inspect inspect_names(const CheckPlan& plan, const ExperimentFile& file);

// Of each text in braces that no row of the table has on its axis, where it stands and the nearest;
// in a reduced sweep that is no mistake.
std::vector<std::string> note_unknown_texts(const CheckPlan& plan, const Table& table);

// The rows of the table that the expression, if there is one, holds for: of points that came to
// their end. Throws base::BadInput where it is not a number.
std::vector<std::size_t> choose_rows(const Rows& rows, const std::optional<Expression>& where);

// Of each row of a reference the rows of the table that its keys speak of; texts are compared as
// texts, numbers as numbers.
std::vector<std::vector<std::size_t>> match_rows(const Table& reference, const Table& table,
                                                 const std::vector<std::string>& keys);

// "3 row(s) of FILE were not run: objects = 400, workers = 1; ...": those without a row of the
// table, of `matches`, but with a number in `column`. None where there is none.
std::optional<std::string> note_missing(const Table& reference, const std::string& name,
                                        const std::string& column,
                                        const std::vector<std::string>& keys,
                                        const std::vector<std::vector<std::size_t>>& matches);

// "2 point(s) left out, ...": that need other rows that are not there. None for no such points.
std::optional<std::string> note_left_out(const Table& table, const std::vector<std::size_t>& rows);

// "objects = 200, workers = 1"
std::string name_row(const Table& table, const std::vector<Value>& row,
                     const std::vector<std::string>& columns);
std::string name_axes(const Table& table, std::size_t row);

}  // namespace laboratory
