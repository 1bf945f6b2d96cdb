#include "experiments/laboratory/points/view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "base/message.hpp"
#include "base/text.hpp"
#include "experiments/laboratory/file/expression.hpp"
#include "experiments/laboratory/points/means.hpp"
#include "experiments/laboratory/table/samples.hpp"

namespace laboratory {
namespace {

using Texts = std::vector<std::string>;

constexpr const char* ENDED = "ended";

bool contains(const Texts& texts, const std::string& text) {
  return std::ranges::find(texts, text) != texts.end();
}

// The names that the file's plots, checks and [[best]] use, directly or through names of [let].
std::set<std::string> find_asked(const ExperimentFile& file) {
  std::map<std::string, std::string> formulas;
  for (const Definition& definition : file.definitions)
    formulas.emplace(definition.name, definition.formula);
  std::set<std::string> names;
  for (const auto& baseline : file.baselines) names.insert(baseline.column());
  Texts expressions;
  for (const auto& check : file.checks) expressions.push_back(check.of);
  for (const auto& plot : file.plots)
    expressions.insert(expressions.end(), plot.y.begin(), plot.y.end());
  for (const auto& best : file.bests) expressions.push_back(best.of);
  while (!expressions.empty()) {
    const std::string expression = std::move(expressions.back());
    expressions.pop_back();
    for (const auto& name : Expression(expression, "").names()) {
      const auto formula = formulas.find(name);
      if (names.insert(name).second && formula != formulas.end())
        expressions.push_back(formula->second);
    }
  }
  return names;
}

// The value of a column, if it is the same in all rows.
std::optional<std::string> find_constant(const Table& table, std::size_t column) {
  if (table.rows.empty()) return {};
  const auto& first = table.rows[0][column];
  const auto is_first = [&](const auto& row) { return is_same(row[column], first); };
  if (!std::ranges::all_of(table.rows, is_first)) return {};
  return to_string(first);
}

// Inserts after each shown mean the column with its half widths, if there is one.
void add_half_widths(const Table& table, TableView& view) {
  Texts columns;
  std::size_t least = 0;
  for (std::size_t i = 0; i < view.columns.size(); ++i) {
    columns.push_back(view.columns[i]);
    if (const auto half = view.columns[i] + HALF_WIDTH; table.find(half)) columns.push_back(half);
    if (i + 1 == view.least) least = columns.size();
  }
  view.columns = std::move(columns);
  view.least = least;
}

// True if a speed-up exists in less than half of the completed rows, because only some networks
// have a point with one worker.
bool is_sparse(const Table& table, std::size_t column) {
  const auto& name = table.columns[column];
  if (name != "speedup" && name != "efficiency") return false;
  std::size_t complete = 0, there = 0;
  for (const auto& row : table.rows) {
    if (!is_complete_row(table, row)) continue;
    ++complete;
    there += row[column] != Value();
  }
  return 2 * there < complete;
}

TableView choose_named(const ExperimentFile& file, const Table& table) {
  TableView view;
  const auto& names = file.report.columns;
  if (contains(names, "all")) {
    view.columns = table.columns;
    std::erase_if(view.columns, [](const auto& name) { return name.ends_with(HALF_WIDTH); });
  } else {
    view.columns.assign(table.columns.begin(),
                        table.columns.begin() + static_cast<std::ptrdiff_t>(table.axes));
    for (const auto& name : names)
      if (table.find(SEEDS) && is_seed(name))
        continue;  // the seed is averaged over, and so has no column
      else if (!table.find(name))
        view.unknown.push_back(
            fmt::format("no column \"{}\"{}", name, base::suggest(name, table.columns)));
      else if (!contains(view.columns, name))
        view.columns.push_back(name);
  }
  const auto ended = table.find(ENDED);
  if (ended && find_constant(table, *ended) != "done" && !contains(view.columns, ENDED))
    view.columns.push_back(ENDED);
  view.least = view.columns.size();
  add_half_widths(table, view);
  return view;
}

}  // namespace

TableView choose_view(const ExperimentFile& file, const Table& table) {
  if (!file.report.columns.empty()) return choose_named(file, table);
  TableView view;
  const auto& summary = shows_of(file).summary;
  const auto inputs = input_names(file, table);
  const auto asked = find_asked(file);
  Texts first, others;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const auto& name = table.columns[c];
    const auto constant = find_constant(table, c);
    if (c < table.axes) {
      view.columns.push_back(name);
    } else if (constant == "") {
      continue;  // skips a parameter without effect on any point
    } else if (name.ends_with(HALF_WIDTH)) {
      continue;
    } else if (inputs.contains(name) || name == SEEDS) {
      if (constant)
        view.constants.emplace_back(name, *constant);
      else
        view.columns.push_back(name);
    } else if (asked.contains(name)) {
      first.push_back(name);
    } else if (name == ENDED) {
      if (constant != "done") first.push_back(name);
    } else if ((summary.empty() || contains(summary, name)) && !is_sparse(table, c)) {
      others.push_back(name);
    }
  }
  view.columns.insert(view.columns.end(), first.begin(), first.end());
  view.least = view.columns.size();
  view.columns.insert(view.columns.end(), others.begin(), others.end());
  add_half_widths(table, view);
  return view;
}

std::vector<std::string> fit_columns(const Table& table, const TableView& view, std::size_t width) {
  constexpr std::size_t GAP = 2;
  Texts fitting;
  std::size_t taken = 0;
  for (const auto& name : view.columns) {
    const auto cells = format_column(table, *table.find(name));
    std::size_t widest = width_of(name);
    for (const auto& cell : cells) widest = std::max(widest, width_of(cell));
    taken += (fitting.empty() ? 0 : GAP) + widest;
    if (fitting.size() >= view.least && taken > width) break;
    fitting.push_back(name);
  }
  return fitting;
}

std::string to_text(const Table& table, const TableView& view, std::size_t width) {
  std::string text, line;
  for (const auto& [name, value] : view.constants) {
    const auto item = fmt::format("{} = {}", name, base::blank_controls(value, '?'));
    if (!line.empty() && width_of(line) + width_of(", ,") + width_of(item) > width) {
      text += line + ",\n";
      line.clear();
    }
    line += (line.empty() ? "" : ", ") + item;
  }
  if (!line.empty()) text += line + "\n\n";
  const auto columns = fit_columns(table, view, width);
  text += to_text(table, columns);
  // columns with half widths are not counted, because results.csv does not have them
  const auto is_own = [](const auto& name) { return !name.ends_with(HALF_WIDTH); };
  const auto others = std::ranges::count_if(table.columns, is_own) -
                      std::ranges::count_if(columns, is_own) -
                      static_cast<std::ptrdiff_t>(view.constants.size());
  if (others > 0)
    text += fmt::format("{} more {} in results.csv; --columns NAME,... or all shows {}\n", others,
                        others == 1 ? "column is" : "columns are", others == 1 ? "it" : "them");
  return text;
}

}  // namespace laboratory
