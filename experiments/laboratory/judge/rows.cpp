#include "experiments/laboratory/judge/rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <set>

#include "base/errors.hpp"
#include "base/message.hpp"
#include "base/text.hpp"
#include "experiments/laboratory/points/results.hpp"
#include "experiments/laboratory/setup/setup.hpp"
#include "experiments/laboratory/table/samples.hpp"

namespace laboratory {
namespace {

using base::BadInput;

constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t MOST_NAMED = 5;  // number of rows that a note lists

std::string spell_as_name(std::string text) {
  for (char& c : text)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return text;
}

// Adds a condition to the text of a reference, for an error message: "{time_s @ workers = 1,
// objects = objects}". If the axis has strings, the condition is AXIS = `own`, the string of the
// row being evaluated.
std::string add_condition(const RowReference& reference, const std::string& axis,
                          const Value& own) {
  return fmt::format("{}, {} = {}}}", reference.text.substr(0, reference.text.size() - 1), axis,
                     std::holds_alternative<std::string>(own) ? to_string(own) : axis);
}

std::string join_few(std::vector<std::string> names) {
  const auto count = names.size();
  names.resize(std::min(count, MOST_NAMED));
  return fmt::format("{}{}", fmt::join(names, "; "), count > MOST_NAMED ? "; ..." : "");
}

// Formats the values of some columns in a row: "objects = 200, workers = 1".
std::string name_row(const Table& table, const std::vector<Value>& row,
                     const std::vector<std::string>& columns) {
  std::vector<std::string> parts;
  for (const auto& column : columns)
    parts.push_back(fmt::format("{} = {}", column, to_string(row[*table.find(column)])));
  return join_texts(parts, ", ");
}

}  // namespace

std::string suggest_column(const std::string& name, const std::vector<std::string>& known) {
  // The former names of the farm's columns, each with its present name, which all programs share.
  static const std::map<std::string, std::string> RENAMED = {
      {"data_accesses", "accesses_made"},
      {"hit_local", "local"},
      {"hit_path", "on_path"},
      {"hit_queue", "by_queue"},
      {"hit_server", "at_coordinator"},
      {"hit_disk", "on_disk"},
      {"data_requests", "requests"},
      {"data_request_links", "links_per_request"},
      {"data_links_saved_path", "spared_by_path"},
      {"data_links_saved_queue", "spared_by_queue"},
      {"data_wait_ms", "wait_per_request_s"},
      {"router_messages_max", "most_held"},
      {"messages", "messages_sent"},
      {"message_bytes", "bytes_sent"},
      {"hops_mean", "links_mean"}};
  const auto renamed = RENAMED.find(name);
  const bool is_there =
      renamed != RENAMED.end() && std::ranges::find(known, renamed->second) != known.end();
  return base::suggest(is_there ? renamed->second : name, known);
}

Rows::Rows(const ExperimentFile& file, const Table& table) : file_(file), table_(table) {
  base::check_equal("points of the results", table.count_points(), file.points.size());
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto& experiment = point_of(row).experiment;
    const auto [known, is_new] = models_.try_emplace(model_key(experiment.model));
    if (is_new)
      for (const auto& entry : make_model(experiment.model).entries)
        known->second[entry.key] = entry.value;
    model_of_.push_back(&known->second);
  }
}

bool Rows::is_complete(std::size_t row) const { return is_complete_row(table_, table_.rows[row]); }

const std::string* Rows::find_text(const std::string& name, std::size_t row) const {
  const auto column = table_.find(name);
  return column ? std::get_if<std::string>(&table_.rows[row][*column]) : nullptr;
}

std::optional<double> Rows::find_number(const std::string& name, std::size_t row) const {
  if (find_text(name, row)) return std::nullopt;
  if (const auto column = table_.find(name))
    return as_number(table_.rows[row][*column]).value_or(NOT_A_NUMBER);
  for (const auto* numbers : {model_of_[row], &point_of(row).numbers})
    if (const auto found = numbers->find(name); found != numbers->end()) return found->second;
  return std::nullopt;
}

std::optional<double> Rows::compare_text(const std::string& name, std::size_t row) const {
  const auto spelled = spell_as_name(name);
  for (std::size_t i = 0; i < table_.columns.size(); ++i) {
    const auto& cell = table_.rows[row][i];
    if (!spelled.starts_with(name_comparison(table_.columns[i], ""))) continue;
    if (cell == Value()) return 0;
    if (const auto* text = std::get_if<std::string>(&cell))
      return name_comparison(table_.columns[i], *text) == spelled ? 1 : 0;
  }
  return std::nullopt;
}

std::optional<double> Rows::get(const std::string& name, std::size_t row,
                                const std::string& place) const {
  if (const auto let = lets_.find(name); let != lets_.end()) return let->second[row].value;
  if (const auto number = find_number(name, row)) return number;
  if (const auto equal = compare_text(name, row)) return equal;
  if (const auto* text = find_text(name, row))
    throw BadInput(fmt::format("{}: found {}, which is a text, expected a comparison such as {}",
                               place, name, name_comparison(name, *text)));
  std::set<std::string> known;
  for (const auto& column : table_.columns)
    if (!find_text(column, row)) known.insert(column);
  for (const auto* numbers : {model_of_[row], &point_of(row).numbers})
    for (const auto& [key, value] : *numbers) known.insert(key);
  for (const auto& [let, values] : lets_) known.insert(let);
  throw BadInput(fmt::format("{}: unknown variable \"{}\"{}", place, name,
                             suggest_column(name, {known.begin(), known.end()})));
}

void Rows::define(const std::string& name, const Expression& expression, const std::string& place) {
  std::vector<Evaluated> values;
  for (std::size_t row = 0; row < table_.rows.size(); ++row) {
    values.push_back(eval_at(expression, row));
    base::require(!find_number(name, row) && !find_text(name, row), place,
                  "found {} twice, expected a new name", name);
  }
  lets_.emplace(name, std::move(values));
}

std::optional<std::size_t> Rows::find_row(const RowReference& reference, const std::string& place,
                                          std::size_t row) const {
  auto wanted = table_.rows[row];
  std::vector<bool> is_free(table_.axes);
  for (const auto& condition : reference.conditions) {
    const auto axis =
        find_axis(table_, condition.axis, fmt::format("{}: {}", place, reference.text));
    for (const auto& other : find_coupled(file_, condition.axis))
      if (const auto column = table_.find(other)) is_free[*column] = true;
    if (std::holds_alternative<std::string>(wanted[axis])) {
      wanted[axis] = condition.text;
      continue;
    }
    base::require(condition.value.has_value(), place,
                  "{}: found \"{}\", expected a number for the axis {}", reference.text,
                  condition.text, condition.axis);
    std::vector<double> values;
    for (const auto& name : condition.value->variables()) {
      const auto value = get(name, row, place);
      if (!value) return std::nullopt;
      values.push_back(*value);
    }
    wanted[axis] = condition.value->eval(values);
  }
  for (const auto& condition : reference.conditions) is_free[*table_.find(condition.axis)] = false;
  const auto found = choose_row(reference, place, wanted, is_free);
  return found && is_complete(*found) ? found : std::nullopt;
}

std::optional<std::size_t> Rows::choose_row(const RowReference& reference, const std::string& place,
                                            const std::vector<Value>& wanted,
                                            const std::vector<bool>& is_free) const {
  std::optional<std::size_t> found;
  std::optional<std::size_t> differs;  // an axis on which two matching rows have different values
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
  throw BadInput(fmt::format("{}: {}: found rows with several values of {}, expected one: write {}",
                             place, reference.text, axis,
                             add_condition(reference, axis, wanted[*differs])));
}

void Rows::check(const Expression& expression, std::size_t row) const {
  for (const auto& variable : expression.variables()) {
    const auto* reference = expression.find_reference(variable);
    get(reference ? reference->column : variable, row, expression.place());
    if (reference) find_row(*reference, expression.place(), row);
  }
}

bool Rows::is_gap(const std::string& name, std::size_t row) const {
  if (const auto let = lets_.find(name); let != lets_.end()) return let->second[row].is_gap;
  const auto column = table_.find(name);
  return column && table_.rows[row][*column] == Value();
}

std::optional<double> Rows::eval(const Expression& expression, std::size_t row) const {
  const auto [value, is_gap] = eval_at(expression, row);
  return is_gap ? std::nullopt : value;
}

Rows::Evaluated Rows::eval_at(const Expression& expression, std::size_t row) const {
  std::vector<double> values;
  bool has_gaps = false;
  for (const auto& variable : expression.variables()) {
    std::size_t from = row;
    std::string name = variable;
    if (const auto* reference = expression.find_reference(variable)) {
      const auto found = find_row(*reference, expression.place(), row);
      if (!found) return {};
      from = *found;
      name = reference->column;
    }
    const auto value = get(name, from, expression.place());
    if (!value) return {};
    has_gaps |= is_gap(name, from);
    values.push_back(*value);
  }
  const double value = expression.eval(values);
  return {value, has_gaps && std::isnan(value)};
}

std::vector<std::string> axis_names(const Table& table) {
  return {table.columns.begin(), table.columns.begin() + static_cast<std::ptrdiff_t>(table.axes)};
}

std::vector<std::string> sampled_axis_names(const Table& table) {
  auto names = axis_names(table);
  for (const auto axis : find_seeds(table)) std::erase(names, table.columns[axis]);
  return names;
}

std::vector<Value> take_sampled_axes(const Table& table, std::size_t row) {
  std::vector<Value> cells;
  for (const auto& name : sampled_axis_names(table))
    cells.push_back(table.rows[row][*table.find(name)]);
  return cells;
}

std::string name_sampled_axes(const Table& table, std::size_t row) {
  return name_row(table, table.rows[row], sampled_axis_names(table));
}

std::size_t find_axis(const Table& table, const std::string& axis, const std::string& place) {
  const auto found = table.find(axis);
  if (found && *found < table.axes) return *found;
  throw BadInput(fmt::format("{}: \"{}\" is not an axis of the results{}", place, axis,
                             base::suggest(axis, axis_names(table))));
}

std::string name_comparison(const std::string& column, const std::string& text) {
  return spell_as_name(column) + "_is_" + spell_as_name(text);
}

std::string name_axes(const Table& table, std::size_t row) {
  return name_row(table, table.rows[row], axis_names(table));
}

std::vector<std::size_t> choose_rows(const Rows& rows, const std::optional<Expression>& where) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < rows.table().rows.size(); ++i) {
    if (!rows.is_complete(i)) continue;
    const double holds = where ? rows.eval(*where, i).value_or(0) : 1;
    if (std::isnan(holds))
      base::refuse(where->place(), "found nan at one of the points, expected a number");
    if (holds != 0) chosen.push_back(i);
  }
  return chosen;
}

std::vector<std::pair<std::size_t, double>> match_reference(const Reference& reference,
                                                            const Table& table,
                                                            std::vector<std::string>& notes) {
  const auto& [from, name, column, keys] = reference;
  std::vector<std::pair<std::size_t, double>> matched;
  std::vector<std::string> missing;
  for (const auto& wanted : from.rows) {
    const auto value = as_number(wanted[*from.find(column)]);
    if (!value) continue;
    const auto before = matched.size();
    for (std::size_t i = 0; i < table.rows.size(); ++i)
      if (std::ranges::all_of(keys, [&](const auto& key) {
            const auto& theirs = wanted[*from.find(key)];
            const auto& ours = table.rows[i][*table.find(key)];
            return is_same(ours, as_number(ours) ? unquote_number(theirs) : theirs);
          }))
        matched.emplace_back(i, *value);
    if (matched.size() == before) missing.push_back(name_row(from, wanted, keys));
  }
  if (!missing.empty())
    notes.push_back(
        fmt::format("{} row(s) of {} were not run: {}", missing.size(), name, join_few(missing)));
  return matched;
}

std::optional<std::string> note_left_out(const Table& table, const std::vector<std::size_t>& rows) {
  if (rows.empty()) return std::nullopt;
  std::vector<std::string> names;
  for (const auto row : rows) names.push_back(name_axes(table, row));
  return fmt::format("{} point(s) left out, because a required value is missing: {}", rows.size(),
                     join_few(names));
}

}  // namespace laboratory
