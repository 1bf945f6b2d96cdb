#include "experiments/check_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "experiments/files.hpp"
#include "experiments/machine_model.hpp"
#include "simulator/machine/faults.hpp"
#include "topologies/spelling.hpp"

namespace experiments {

namespace {

using machine::InvalidInput;

// Depth first: what a definition names comes before it.
struct Sorter {
  std::map<std::string, CheckPlan::Let>& left;
  std::vector<CheckPlan::Let>& sorted;
  std::vector<std::string> way;

  void visit(const std::string& name) {
    const auto found = left.find(name);
    if (found == left.end()) return;
    const bool again = std::ranges::find(way, name) != way.end();
    way.push_back(name);
    if (again)
      throw InvalidInput(
          fmt::format("{}: {}, expected definitions that do not need each other",
                      found->second.definition.place,
                      fmt::join(std::ranges::find(way, name), way.end(), " needs ")));
    for (const auto& needed : found->second.formula.variables()) visit(needed);
    way.pop_back();
    sorted.push_back(std::move(found->second));
    left.erase(found);
  }
};

std::vector<CheckPlan::Let> sort_definitions(const std::vector<Definition>& definitions) {
  std::map<std::string, CheckPlan::Let> left;
  for (const auto& d : definitions)
    left.emplace(d.name, CheckPlan::Let{d, machine::Formula(d.formula, d.place)});
  std::vector<CheckPlan::Let> sorted;
  while (!left.empty()) Sorter{left, sorted, {}}.visit(left.begin()->first);
  return sorted;
}

void find_column(const Table& table, const std::string& column, const std::string& place,
                 const std::string& whose) {
  if (table.find(column)) return;
  throw InvalidInput(fmt::format("{}: unknown column \"{}\" of {}, the nearest is \"{}\"", place,
                                 column, whose, topologies::nearest_name(column, table.columns)));
}

Table parse_reference(const Check& check) {
  try {
    return parse_csv(read_file(check.reference), check.reference);
  } catch (const std::exception& error) {
    throw InvalidInput(fmt::format("{}: reference: {}", check.place, error.what()));
  }
}

Table read_reference(const Check& check) {
  Table table = parse_reference(check);
  for (const auto& key : check.keys)
    find_column(table, key, check.place + ": keys", check.reference);
  find_column(table, check.column, check.place + ": column", check.reference);
  const auto column = *table.find(check.column);
  for (const auto& row : table.rows)
    if (std::holds_alternative<std::string>(row[column]))
      throw InvalidInput(
          fmt::format("{}: {}, column {}: found \"{}\", expected a number or nothing", check.place,
                      check.reference, check.column, to_string(row[column])));
  return table;
}

// Every formula of the plan, with what visits it.
template <class Visit>
void for_each_formula(const CheckPlan& plan, const Visit& visit) {
  for (const auto& let : plan.lets) visit(let.formula);
  for (const auto& c : plan.comparisons) {
    if (c.formula) visit(*c.formula);
    if (c.where) visit(*c.where);
  }
}

// Keys and numbers of the model have dots and are known before the run; columns come later.
void check_dotted_names(const CheckPlan& plan, const ExperimentFile& file) {
  const auto& point = file.points[0];
  Variables variables(point, make_model(point.experiment));
  for (const auto& let : plan.lets) variables.add(let.definition.name, 0, let.definition.place);
  for_each_formula(plan, [&](const machine::Formula& formula) {
    for (const auto& name : formula.variables())
      if (name.find('.') != std::string::npos) variables.get(name, formula.place());
  });
}

}  // namespace

CheckPlan plan_checks(const ExperimentFile& file) {
  CheckPlan plan;
  plan.lets = sort_definitions(file.definitions);
  for (const auto& check : file.checks) {
    CheckPlan::Comparison c{check, {}, {}, {}};
    if (!check.formula.empty()) c.formula.emplace(check.formula, check.place + ": formula");
    if (!check.where.empty()) c.where.emplace(check.where, check.place + ": where");
    if (!check.reference.empty()) c.reference = read_reference(check);
    plan.comparisons.push_back(std::move(c));
  }
  if (!plan.lets.empty() || !plan.comparisons.empty()) check_dotted_names(plan, file);
  return plan;
}

Variables make_variables(const CheckPlan& plan, const Point& point, const machine::Model& model,
                         const Table& table, const std::vector<Value>& row) {
  Variables variables(point, model);
  variables.add_row(table, row);
  for (const auto& [definition, formula] : plan.lets)
    variables.add(definition.name,
                  formula.eval(variables.get_all(formula.variables(), formula.place())),
                  definition.place);
  return variables;
}

void check_names(const CheckPlan& plan, const ExperimentFile& file, std::size_t point,
                 const Table& table, const std::vector<Value>& row) {
  if (plan.comparisons.empty()) return;
  const auto& at = file.points[point];
  const auto variables = make_variables(plan, at, make_model(at.experiment), table, row);
  for_each_formula(plan, [&](const machine::Formula& formula) {
    variables.get_all(formula.variables(), formula.place());
  });
  for (const auto& c : plan.comparisons) {
    find_column(table, c.check.of, c.check.place + ": of", "the results");
    if (std::holds_alternative<std::string>(row[*table.find(c.check.of)]))
      throw InvalidInput(fmt::format("{}: of: {} is a text, expected a column of numbers",
                                     c.check.place, c.check.of));
    for (const auto& key : c.check.keys)
      find_column(table, key, c.check.place + ": keys", "the results");
  }
}

}  // namespace experiments
