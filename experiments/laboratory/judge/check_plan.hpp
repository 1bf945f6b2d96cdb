#pragma once
// The checks and figures of an experiment, read and compiled. Reports every error that can be found
// before a run.
#include <optional>
#include <vector>

#include "experiments/laboratory/judge/rows.hpp"
#include "experiments/laboratory/points/points.hpp"

namespace laboratory {

struct CheckPlan {
  struct Let {
    Definition definition;
    Expression formula;
  };
  struct Comparison {
    Check check;
    std::optional<Expression> of = {};  ///< none for a plain column
    std::optional<Expression> formula = {}, at_least = {}, at_most = {};
    std::optional<Expression> where = {}, calibrated = {};
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
  struct Baseline {
    std::string column;
    Expression of;
  };
  std::vector<Baseline> baselines;
  std::vector<Let> lets;  ///< in order of dependency
  std::vector<Comparison> comparisons;
  std::vector<Figure> figures;      ///< [[plot]]
  std::vector<Question> questions;  ///< [[best]]

  bool is_empty() const {
    return baselines.empty() && comparisons.empty() && figures.empty() && questions.empty();
  }
};

/// Throws base::BadInput for invalid expressions, circular definitions, names with a dot that no
/// point knows, and unreadable references. Names without a dot may be columns, still unknown here.
CheckPlan plan_checks(const ExperimentFile& file);

/// The table of results with a column for each [[baseline]]; a cell is empty if its baseline row is
/// missing. Throws base::BadInput for unknown names.
Table make_table(const CheckPlan& plan, const ExperimentFile& file, const Results& results);

/// All rows with the plan's definitions. The file and the table must outlive the result.
Rows make_rows(const CheckPlan& plan, const ExperimentFile& file, const Table& table);

/// Throws BadInput for names in the plan that are unknown at this row.
void check_names(const CheckPlan& plan, const Rows& rows, std::size_t row);

/// A callback for PointsPlan that calls check_names for each point upon completion. The plan and
/// the file must outlive it.
Inspect inspect_names(const CheckPlan& plan, const ExperimentFile& file);

/// Notes for every [[baseline]] with an empty column, and for every text in braces that no row has
/// on its axis: its position, and the nearest value. This is valid in a reduced sweep.
std::vector<std::string> note_unknown_texts(const CheckPlan& plan, const Table& table);

}  // namespace laboratory
