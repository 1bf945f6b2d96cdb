#include "experiments/laboratory/judge/check_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ranges>
#include <set>
#include <tuple>

#include "base/errors.hpp"
#include "base/message.hpp"
#include "base/order.hpp"
#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/points/results.hpp"
#include "experiments/laboratory/setup/setup.hpp"
#include "experiments/laboratory/table/samples.hpp"

namespace laboratory {
namespace {

using base::BadInput;

// Sorts the definitions of [let] topologically, so that each comes after the names that it uses.
std::vector<CheckPlan::Let> sort_definitions(const std::vector<Definition>& definitions) {
  std::map<std::string, std::size_t> index_of;
  std::vector<CheckPlan::Let> lets;
  for (const auto& d : definitions) {
    index_of.emplace(d.name, index_of.size());
    lets.push_back({d, Expression(d.formula, d.place)});
  }
  std::vector<std::vector<std::size_t>> needs(lets.size());
  for (std::size_t i = 0; i < lets.size(); ++i)
    for (const auto& name : lets[i].formula.names())
      if (const auto found = index_of.find(name); found != index_of.end())
        needs[i].push_back(found->second);
  auto [order, circle] = base::sort_by_needs(needs);
  if (!circle.empty()) {
    const auto& place = definitions[circle[0]].place;
    circle.push_back(circle[0]);
    const auto name_of = [&](std::size_t i) { return definitions[i].name; };
    base::refuse(place, "found {}, expected definitions without a cycle",
                 fmt::join(circle | std::views::transform(name_of), " needs "));
  }
  std::vector<CheckPlan::Let> sorted;
  for (const auto i : order) sorted.push_back(std::move(lets[i]));
  return sorted;
}

void find_column(const Table& table, const std::string& column, const std::string& place,
                 const std::string& owner) {
  if (!table.find(column))
    base::refuse(place, "unknown column \"{}\" of {}{}", column, owner,
                 suggest_column(column, table.columns));
}

Table parse_reference(const std::string& path, const std::string& place) {
  try {
    return parse_csv(base::read_text(path), path);
  } catch (const std::exception& error) {
    throw BadInput(fmt::format("{}: reference: {}", place, error.what()));
  }
}

// Reads the reference table that a [[check]] or a [[plot]] names.
template <class Spec>
std::optional<Table> read_reference(const Spec& spec) {
  if (spec.reference.path.empty()) return std::nullopt;
  Table table = parse_reference(spec.reference.path, spec.place);
  for (const auto& key : spec.keys)
    find_column(table, key, spec.place + ": keys", spec.reference.path);
  find_column(table, spec.column, spec.place + ": column", spec.reference.path);
  const auto column = *table.find(spec.column);
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    auto& cell = table.rows[r][column];
    cell = unquote_number(cell);
    const auto number = as_number(cell);
    base::require(cell == Value() || (number && std::isfinite(*number)), spec.place,
                  "{}:{}, column {}: found \"{}\", expected a finite number or nothing",
                  spec.reference.path, table.lines[r], spec.column, to_string(cell));
  }
  return table;
}

// Calls `visit` for every expression of the plan.
template <class Visit>
void for_each_expression(const CheckPlan& plan, const Visit& visit) {
  const auto visit_all = [&](std::initializer_list<const std::optional<Expression>*> all) {
    for (const auto* expression : all)
      if (*expression) visit(**expression);
  };
  for (const auto& b : plan.baselines) visit(b.of);
  for (const auto& let : plan.lets) visit(let.formula);
  for (const auto& c : plan.comparisons)
    visit_all({&c.of, &c.formula, &c.at_least, &c.at_most, &c.where, &c.calibrated});
  for (const auto& f : plan.figures) {
    visit(f.x);
    for (const auto& y : f.y) visit(y);
    visit_all({&f.where, &f.growth});
  }
  for (const auto& q : plan.questions) {
    visit(q.of);
    visit_all({&q.where});
  }
}

// Throws for unknown names with a dot. They can be checked before the simulation, because such
// names are keys or model entries. Skips names without a dot, which may be columns of results. Also
// skips names with "_is_": the rest of the name may be a text from a results column, as in
// topology_is_net.dot.
void check_dotted_names(const CheckPlan& plan, const ExperimentFile& file) {
  ExperimentFile first;
  first.points = {file.points[0]};
  const Table empty{.columns = {}, .rows = {{}}};
  Rows rows(first, empty);
  for (const auto& [name, formula, place] : file.definitions)
    rows.define(name, Expression("0", place), place);
  for_each_expression(plan, [&](const Expression& expression) {
    for (const auto& name : expression.variables()) {
      const auto* reference = expression.find_reference(name);
      const auto& wanted = reference ? reference->column : name;
      if (wanted.find('.') != std::string::npos && wanted.find("_is_") == std::string::npos)
        rows.get(wanted, 0, expression.place());
    }
  });
}

// Throws for names of columns that no point can have. Skips names that check_dotted_names checks,
// and names with "_is_".
void check_column_names(const CheckPlan& plan, const ExperimentFile& file) {
  auto known = declared_columns(file);
  for (const auto& baseline : plan.baselines) known.push_back(baseline.column);
  for (const auto& [name, formula, place] : file.definitions) known.push_back(name);
  const auto is_known = [&](const std::string& name) {
    return name.find('.') != name.npos || name.find("_is_") != name.npos ||
           is_declared(known, name) || file.points[0].numbers.contains(name);
  };
  const auto check_column = [&](const std::string& name, const std::string& place) {
    if (!is_known(name))
      base::refuse(place, "unknown column \"{}\" of the results{}", name,
                   suggest_column(name, known));
  };
  for (const auto& c : plan.comparisons) {
    if (!c.of) check_column(c.check.of, c.check.place + ": of");
    for (const auto& key : c.check.keys) check_column(key, c.check.place + ": keys");
  }
  for (const auto& f : plan.figures)
    for (const auto& key : f.spec.keys) check_column(key, f.spec.place + ": keys");
  for_each_expression(plan, [&](const Expression& expression) {
    for (const auto& variable : expression.variables()) {
      const auto* reference = expression.find_reference(variable);
      const auto& name = reference ? reference->column : variable;
      base::require(is_known(name), expression.place(), "unknown variable \"{}\"{}", name,
                    suggest_column(name, known));
    }
  });
}

std::optional<Expression> compile(const std::string& text, const std::string& place,
                                  const char* key) {
  if (text.empty()) return std::nullopt;
  return Expression(text, fmt::format("{}: {}", place, key));
}

std::vector<Expression> compile_all(const std::vector<std::string>& texts,
                                    const std::string& place) {
  std::vector<Expression> expressions;
  for (const auto& text : texts) expressions.emplace_back(text, place);
  return expressions;
}

bool is_defined(const ExperimentFile& file, const std::string& name) {
  return std::ranges::find(file.definitions, name, &Definition::name) != file.definitions.end();
}

// Lists the strings in an axis's column of the table; empty if the column has numbers.
std::vector<std::string> texts_of(const Table& table, const std::string& axis) {
  std::vector<std::string> texts;
  if (const auto column = table.find(axis))
    for (const auto& row : table.rows)
      if (const auto* text = std::get_if<std::string>(&row[*column])) texts.push_back(*text);
  return texts;
}

void check_axes(const Table& table, const std::vector<std::string>& axes,
                const std::string& place) {
  for (const auto& axis : axes) {
    find_axis(table, axis, place);
    base::require(!is_seed(axis), place,
                  "found {}, whose values are samples, expected another axis: results are means "
                  "over seeds",
                  axis);
  }
}

void check_columns(const CheckPlan& plan, const Table& table, const std::vector<Value>& row) {
  for (const auto& c : plan.comparisons) {
    const auto& [of, place] = std::tie(c.check.of, c.check.place);
    if (!c.of) find_column(table, of, place + ": of", "the results");
    base::require(c.of || !std::holds_alternative<std::string>(row[*table.find(of)]), place,
                  "of: found {}, which is a text, expected a column of numbers", of);
    for (const auto& key : c.check.keys) find_column(table, key, place + ": keys", "the results");
  }
  for (const auto& f : plan.figures) {
    for (const auto& name : f.x.names())
      if (is_seed(name) && table.find(name)) check_axes(table, {name}, f.x.place());
    if (f.spec.series) check_axes(table, *f.spec.series, f.spec.place + ": series");
    for (const auto& key : f.spec.keys)
      find_column(table, key, f.spec.place + ": keys", "the results");
  }
  for (const auto& [spec, of, where] : plan.questions) {
    check_axes(table, spec.over, spec.place + ": over");
    check_axes(table, spec.for_each, spec.place + ": for_each");
    if (!spec.pays.empty()) check_axes(table, {spec.pays}, spec.place + ": pays");
  }
}

// Adds a note if `name` compares a column with a text that no row has, or with a text that several
// different texts of the column match. The name topology_is_mesh compares the column `topology`
// with the text "mesh".
void note_comparison(const std::string& name, const std::string& place, const Table& table,
                     std::vector<std::string>& notes) {
  if (table.find(name)) return;
  for (const auto& column : table.columns) {
    const auto prefix = name_comparison(column, "");
    if (!name.starts_with(prefix)) continue;
    const auto asked = name_comparison(column, name.substr(prefix.size()));
    std::set<std::string> equal;
    std::vector<std::string> names;
    for (const auto& text : texts_of(table, column)) {
      names.push_back(name_comparison(column, text));
      if (names.back() == asked) equal.insert(text);
    }
    if (names.empty()) continue;
    if (equal.empty())
      notes.push_back(fmt::format("{}: {}: found no point with this {}{}", place, name, column,
                                  base::suggest(name, names)));
    if (equal.size() > 1)
      notes.push_back(fmt::format("{}: {}: this name matches several texts: {}", place, name,
                                  fmt::join(equal, ", ")));
  }
}

}  // namespace

std::vector<std::string> note_unknown_texts(const CheckPlan& plan, const Table& table) {
  std::vector<std::string> notes;
  for (const auto& [column, of] : plan.baselines)
    if (const auto at = table.find(column);
        at && std::ranges::all_of(table.rows, [&](const auto& row) { return row[*at] == Value(); }))
      notes.push_back(fmt::format(
          "{}: the row to compare with is missing or incomplete: {} is empty", of.place(), column));
  for_each_expression(plan, [&](const Expression& expression) {
    for (const auto& variable : expression.variables()) {
      const auto* reference = expression.find_reference(variable);
      if (!reference) {
        note_comparison(variable, expression.place(), table, notes);
        continue;
      }
      for (const auto& [axis, text, value] : reference->conditions) {
        const auto texts = texts_of(table, axis);
        if (texts.empty() || std::ranges::find(texts, text) != texts.end()) continue;
        notes.push_back(fmt::format("{}: {}: found no point with {} = {}{}", expression.place(),
                                    reference->text, axis, text, base::suggest(text, texts)));
      }
    }
  });
  return notes;
}

namespace {

// Compiles a [[plot]]. The x of a histogram is no expression.
CheckPlan::Figure plan_figure(const PlotSpec& plot, const ExperimentFile& file) {
  const auto place = plot.place + ": x";
  const bool is_histogram = plot.kind == PlotKind::histogram;
  if (const auto known = find_histograms(file);
      is_histogram && std::ranges::find(known, plot.x) == known.end())
    base::refuse(place, "found {}, expected a quantity with a histogram{}", plot.x,
                 base::suggest(plot.x, known));
  return {plot,
          Expression(is_histogram ? "0" : plot.x, place),
          compile_all(plot.y, plot.place + ": y"),
          compile(plot.where, plot.place, "where"),
          compile(plot.growth, plot.place, "growth"),
          read_reference(plot)};
}

}  // namespace

CheckPlan plan_checks(const ExperimentFile& file) {
  CheckPlan plan;
  for (const auto& b : file.baselines) {
    base::require(!is_defined(file, b.of), b.place + ": of",
                  "found {}, a name of [let], expected a column of the results", b.of);
    plan.baselines.push_back(
        {b.column(), Expression(fmt::format("{{{0} @ {1}}} / {0}", b.of, b.at), b.place)});
  }
  plan.lets = sort_definitions(file.definitions);
  for (const auto& c : file.checks) {
    auto of = is_defined(file, c.of) ? compile(c.of, c.place, "of") : std::nullopt;
    plan.comparisons.push_back({c, std::move(of), compile(c.formula, c.place, "formula"),
                                compile(c.at_least, c.place, "at_least"),
                                compile(c.at_most, c.place, "at_most"),
                                compile(c.where, c.place, "where"),
                                compile(c.calibrated, c.place, "calibrated"), read_reference(c)});
  }
  for (const auto& plot : file.plots) plan.figures.push_back(plan_figure(plot, file));
  for (const auto& best : file.bests)
    plan.questions.push_back(
        {best, Expression(best.of, best.place + ": of"), compile(best.where, best.place, "where")});
  if (!plan.lets.empty() || !plan.is_empty()) {
    check_dotted_names(plan, file);
    check_column_names(plan, file);
  }
  return plan;
}

Table make_table(const CheckPlan& plan, const ExperimentFile& file, const Results& results) {
  Table table = make_table(file, results);
  for (const auto& [column, of] : plan.baselines) {
    base::require(!table.find(column), of.place(), "found a column {}, expected a new name",
                  column);
    const Rows rows(file, table);
    std::vector<std::optional<double>> values;
    for (std::size_t row = 0; row < table.rows.size(); ++row)
      values.push_back(rows.is_complete(row) ? rows.eval(of, row) : std::nullopt);
    table.columns.push_back(column);
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      Value& cell = table.rows[row].emplace_back();
      if (values[row] && std::isfinite(*values[row])) cell = *values[row];
    }
  }
  return table;
}

Rows make_rows(const CheckPlan& plan, const ExperimentFile& file, const Table& table) {
  Rows rows(file, table);
  for (const auto& [definition, formula] : plan.lets)
    rows.define(definition.name, formula, definition.place);
  return rows;
}

void check_names(const CheckPlan& plan, const Rows& rows, std::size_t row) {
  for_each_expression(plan, [&](const Expression& expression) { rows.check(expression, row); });
  check_columns(plan, rows.table(), rows.table().rows[row]);
}

Inspect inspect_names(const CheckPlan& plan, const ExperimentFile& file) {
  if (plan.is_empty()) return {};
  return [&](const Point& point, const PointResult& result) {
    if (!result.is_complete()) return;
    ExperimentFile alone;
    alone.sweep = file.sweep;
    alone.points = {point};
    const Table table = make_table(plan, alone, {result});
    check_names(plan, make_rows(plan, alone, table), 0);
  };
}

}  // namespace laboratory
