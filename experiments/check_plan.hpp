#pragma once
// The checks of an experiment, read and compiled: everything that can be wrong with them before
// anything runs has been found.
#include <optional>
#include <vector>

#include "experiments/experiment.hpp"
#include "experiments/table.hpp"
#include "experiments/variables.hpp"
#include "simulator/machine/formula.hpp"

namespace experiments {

struct CheckPlan {
  struct Let {
    Definition definition;
    machine::Formula formula;
  };
  struct Comparison {
    Check check;
    std::optional<machine::Formula> formula, where;
    std::optional<Table> reference;
  };
  std::vector<Let> lets;  // each after those it names
  std::vector<Comparison> comparisons;
};

// Throws machine::InvalidInput for what is no expression, for definitions that need each other, for
// names with a dot that no point knows, and for a reference that cannot be read. Names without a
// dot may be columns, which are not known yet.
CheckPlan plan_checks(const ExperimentFile& file);

// What all formulas of a plan may name at one point: its row, and the definitions.
Variables make_variables(const CheckPlan& plan, const Point& point, const machine::Model& model,
                         const Table& table, const std::vector<Value>& row);

// Throws machine::InvalidInput for names in the plan that are unknown at a point with this row.
void check_names(const CheckPlan& plan, const ExperimentFile& file, std::size_t point,
                 const Table& table, const std::vector<Value>& row);

}  // namespace experiments
