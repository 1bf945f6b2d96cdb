#pragma once
// Compiles the checks and plots of an experiment file, and reports every error that can be found
// before the simulation.
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
    /// the checked value as an expression; none if it is a column of the results
    std::optional<Expression> of = {};
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
  /// names of [let] with their formulas; each comes after the names that it uses
  std::vector<Let> lets;
  std::vector<Comparison> comparisons;
  std::vector<Figure> figures;      ///< compiled tables [[plot]]
  std::vector<Question> questions;  ///< compiled tables [[best]]

  bool is_empty() const {
    return baselines.empty() && comparisons.empty() && figures.empty() && questions.empty();
  }
};

/// Compiles the checks and plots of a file. Throws base::BadInput for invalid expressions, circular
/// definitions, unreadable reference tables, and names with a dot that are unknown at the first
/// point, and names without a dot that no program of the file declares as columns of its results.
CheckPlan plan_checks(const ExperimentFile& file);

/// Makes the results table, with an additional column for each [[baseline]]. A row's cell in such a
/// column is empty if the table has no baseline row for this row. Throws base::BadInput for unknown
/// names.
Table make_table(const CheckPlan& plan, const ExperimentFile& file, const Results& results);

/// Makes the object that evaluates expressions in rows of the table, with the plan's names of
/// [let]. The file and the table must outlive the result.
Rows make_rows(const CheckPlan& plan, const ExperimentFile& file, const Table& table);

/// Throws BadInput if the plan uses names that are unknown in this row.
void check_names(const CheckPlan& plan, const Rows& rows, std::size_t row);

/// Makes a function for PointsPlan that calls check_names() for each completed point. The plan and
/// the file must outlive this function.
Inspect inspect_names(const CheckPlan& plan, const ExperimentFile& file);

/// Makes a note about every [[baseline]] whose column is empty, and about every text in a reference
/// {COLUMN @ AXIS = TEXT} that no row has on that axis. Each note gives the position and the
/// nearest valid value. These are notes, not errors, because they are normal in a reduced sweep.
std::vector<std::string> note_unknown_texts(const CheckPlan& plan, const Table& table);

}  // namespace laboratory
