#include "experiments/laboratory/judge/rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/errors.hpp"
#include "base/spelling.hpp"
#include "experiments/laboratory/points/machine_model.hpp"
#include "experiments/laboratory/points/results.hpp"

namespace laboratory {

namespace {

using base::BadInput;

// "{time_s @ workers = 1, objects = objects}"; for an axis of texts the own text.
std::string add_condition(const RowReference& reference, const std::string& axis,
                          const Value& own) {
  return fmt::format("{}, {} = {}}}", reference.text.substr(0, reference.text.size() - 1), axis,
                     std::holds_alternative<std::string>(own) ? to_string(own) : axis);
}

}  // namespace

Rows::Rows(const ExperimentFile& file, const Table& table) : file_(file), table_(table) {
  base::check_equal("points of the results", table.count_points(), file.points.size());
  std::map<std::string, machine::Model> models;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const auto& point = file.points[table.point_of(i)];
    const auto& experiment = point.experiment;
    const auto key = model_key(experiment);
    if (!models.contains(key)) models.emplace(key, make_model(experiment));
    variables_.emplace_back(point, models.at(key)).add_row(table, table.rows[i]);
  }
  missing_.resize(table.rows.size());
}

bool Rows::is_complete(std::size_t row) const { return is_complete_row(table_, table_.rows[row]); }

void Rows::define(const std::string& name, const Expression& expression, const std::string& place) {
  std::vector<std::optional<double>> values;
  for (std::size_t row = 0; row < variables_.size(); ++row) values.push_back(eval(expression, row));
  for (std::size_t row = 0; row < variables_.size(); ++row) {
    variables_[row].add(name, values[row].value_or(0), place);
    if (!values[row]) missing_[row].insert(name);
  }
}

std::size_t Rows::find_axis(const RowReference& reference, const std::string& axis,
                            const std::string& place) const {
  const auto found = table_.find(axis);
  if (found && *found < table_.axes) return *found;
  const std::vector<std::string> axes(
      table_.columns.begin(), table_.columns.begin() + static_cast<std::ptrdiff_t>(table_.axes));
  throw BadInput(fmt::format("{}: {}: \"{}\" is no axis of the results, the nearest is \"{}\"",
                             place, reference.text, axis, base::nearest_name(axis, axes)));
}

std::optional<std::size_t> Rows::find_row(const RowReference& reference, const std::string& place,
                                          std::size_t row) const {
  auto wanted = table_.rows[row];
  std::vector<bool> is_free(table_.axes);
  for (const auto& condition : reference.conditions) {
    const auto axis = find_axis(reference, condition.axis, place);
    for (const auto& other : find_coupled(file_, condition.axis))
      if (const auto column = table_.find(other)) is_free[*column] = true;
    if (std::holds_alternative<std::string>(wanted[axis])) {
      wanted[axis] = condition.text;
      continue;
    }
    if (!condition.value)
      throw BadInput(fmt::format("{}: {}: found \"{}\", expected a number for the axis {}", place,
                                 reference.text, condition.text, condition.axis));
    const auto& names = condition.value->variables();
    for (const auto& name : names)
      if (missing_[row].contains(name)) return std::nullopt;
    wanted[axis] = condition.value->eval(variables_[row].get_all(names, place));
  }
  for (const auto& condition : reference.conditions) is_free[*table_.find(condition.axis)] = false;
  const auto found = choose_row(reference, place, wanted, is_free);
  return found && is_complete(*found) ? found : std::nullopt;
}

std::optional<std::size_t> Rows::choose_row(const RowReference& reference, const std::string& place,
                                            const std::vector<Value>& wanted,
                                            const std::vector<bool>& is_free) const {
  std::optional<std::size_t> found;
  std::optional<std::size_t> differs;  // an axis on which others differ from the one found
  for (std::size_t i = 0; i < table_.rows.size(); ++i) {
    const auto& row = table_.rows[i];
    bool fits = true, is_it = true;
    for (std::size_t axis = 0; fits && axis < table_.axes; ++axis) {
      const bool same = is_same(row[axis], wanted[axis]);
      fits = same || is_free[axis];
      is_it = is_it && same;
    }
    if (fits && is_it) return i;
    if (!fits) continue;
    for (std::size_t axis = 0; found && axis < table_.axes; ++axis)
      if (!is_same(row[axis], table_.rows[*found][axis])) differs = axis;
    if (!found) found = i;
  }
  if (!differs) return found;
  const auto& axis = table_.columns[*differs];
  throw BadInput(fmt::format("{}: {}: found rows of several {}, expected one: say {}", place,
                             reference.text, axis,
                             add_condition(reference, axis, wanted[*differs])));
}

void Rows::check(const Expression& expression, std::size_t row) const {
  for (const auto& variable : expression.variables()) {
    const auto* reference = expression.find_reference(variable);
    variables_[row].get(reference ? reference->column : variable, expression.place());
    if (reference) find_row(*reference, expression.place(), row);
  }
}

std::optional<double> Rows::eval(const Expression& expression, std::size_t row) const {
  std::vector<double> values;
  for (const auto& variable : expression.variables()) {
    std::size_t from = row;
    std::string name = variable;
    if (const auto* reference = expression.find_reference(variable)) {
      const auto found = find_row(*reference, expression.place(), row);
      if (!found) return std::nullopt;
      from = *found;
      name = reference->column;
    }
    if (missing_[from].contains(name)) return std::nullopt;
    values.push_back(variables_[from].get(name, expression.place()));
  }
  return expression.eval(values);
}

}  // namespace laboratory
