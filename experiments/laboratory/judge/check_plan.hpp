#pragma once
// Compilation of an experiment file's checks and plots. It reports every error that can be found
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
    std::optional<Expression> of = {};  ///< the value as an expression; none if it is a column
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
  std::vector<Let> lets;  ///< names of [let], sorted so that each comes after those it uses
  std::vector<Comparison> comparisons;
  std::vector<Figure> figures;      ///< compiled tables [[plot]]
  std::vector<Question> questions;  ///< compiled tables [[best]]

  bool is_empty() const {
    return baselines.empty() && comparisons.empty() && figures.empty() && questions.empty();
  }
};

/// Compiles the checks and plots of a file. Throws base::BadInput for invalid expressions, circular
/// definitions, unreadable references, and names with a dot that no point defines. Names without a
/// dot may be result columns, which are checked after the run.
CheckPlan plan_checks(const ExperimentFile& file);

/// Makes the table of results and adds a column for each [[baseline]]. Its cell is empty in rows
/// whose baseline row is missing. Throws base::BadInput for unknown names.
Table make_table(const CheckPlan& plan, const ExperimentFile& file, const Results& results);

/// Makes the rows of the table with the definitions of the plan. The file and the table must
/// outlive the result.
Rows make_rows(const CheckPlan& plan, const ExperimentFile& file, const Table& table);

/// Throws BadInput if the plan uses names that are unknown in this row.
void check_names(const CheckPlan& plan, const Rows& rows, std::size_t row);

/// Makes a callback for PointsPlan that calls check_names for each completed point. The plan and
/// the file must outlive it.
Inspect inspect_names(const CheckPlan& plan, const ExperimentFile& file);

/// Makes notes about every [[baseline]] with an empty column, and about every text in braces that
/// no row has on its axis. Each note gives the position and the nearest value. In a reduced sweep
/// such baselines and texts are valid.
std::vector<std::string> note_unknown_texts(const CheckPlan& plan, const Table& table);

}  // namespace laboratory
