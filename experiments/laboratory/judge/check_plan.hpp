#pragma once
// The checks and figures of an experiment, read and compiled: everything that can be wrong with
// them before anything runs has been found.
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
    std::optional<Expression> of = {};  ///< none where it is a column
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
  std::vector<Let> lets;  ///< each after those that it names
  std::vector<Comparison> comparisons;
  std::vector<Figure> figures;      ///< [[plot]]
  std::vector<Question> questions;  ///< [[best]]

  bool is_empty() const {
    return baselines.empty() && comparisons.empty() && figures.empty() && questions.empty();
  }
};

/// Throws base::BadInput for what is no expression, for definitions that need each other, for names
/// with a dot that no point knows, and for a reference that cannot be read. Names without a dot may
/// be columns, which are not known yet.
CheckPlan plan_checks(const ExperimentFile& file);

/// The table of results with a column for each [[baseline]], empty where a row lacks the one that
/// it is compared with. Throws base::BadInput for names that are unknown.
Table make_table(const CheckPlan& plan, const ExperimentFile& file, const Results& results);

/// Every row with the plan's definitions. The file and the table must outlive it.
Rows make_rows(const CheckPlan& plan, const ExperimentFile& file, const Table& table);

/// Throws BadInput for names in the plan that are unknown at this row.
void check_names(const CheckPlan& plan, const Rows& rows, std::size_t row);

/// Calls check_names for each point as soon as it has come to its end: for PointsPlan. The plan and
/// the file must outlive it.
Inspect inspect_names(const CheckPlan& plan, const ExperimentFile& file);

/// A note for each [[baseline]] whose column is empty, and for each text in braces that no row of
/// the table has on its axis: where it stands, and the nearest. In a reduced sweep that is no
/// mistake.
std::vector<std::string> note_unknown_texts(const CheckPlan& plan, const Table& table);

}  // namespace laboratory
