#include "experiments/laboratory/points/results.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/errors.hpp"
#include "experiments/laboratory/table/laws.hpp"

namespace laboratory {
namespace {

constexpr double EXACT = 0x1p53;  // doubles represent every integer below this limit

// Lists the programs that the points use, each once.
std::vector<const programs::Program*> programs_of(const ExperimentFile& file) {
  std::vector<const programs::Program*> all;
  for (const auto& point : file.points)
    if (std::ranges::find(all, point.experiment.program) == all.end())
      all.push_back(point.experiment.program);
  return all;
}

// The name of an axis's column in the results table.
std::string column_of(const ExperimentFile& file, const std::string& axis) {
  return axis == "workers" ? programs_of(file)[0]->processors : axis;
}

// A results table that is filled cell by cell. A new column name appends a column.
class Filling {
 public:
  Filling(Table& table) : table_(table) {}

  void begin() { table_.rows.emplace_back(table_.columns.size()); }
  // Sets a cell of the last row. If a value is both an input and a result, both are put into the
  // same cell, and must be equal.
  void put(const std::string& column, const Value& value) {
    auto known = table_.find(column);
    if (!known) {
      known = table_.columns.size();
      table_.columns.push_back(column);
      for (auto& row : table_.rows) row.emplace_back();
    }
    Value& cell = table_.rows.back()[*known];
    if (cell == Value()) {
      cell = value;
    } else if (const auto found = as_number(value), there = as_number(cell); found && there) {
      base::check_equal(("two columns " + column).c_str(), *found, *there);
    }
  }

 private:
  Table& table_;
};

Value to_value(const base::Scalar& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return *whole;
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* source = std::get_if<base::Source>(&value)) return source->text;
  return {};
}

// Adds the cells of a point's inputs that are not axes of the sweep.
void put_inputs(Filling& filling, const Experiment& experiment, const PointResult& result) {
  const auto& program = *experiment.program;
  if (program.uses.network) {
    filling.put("topology", experiment.topology.text);
    filling.put(program.processors, std::int64_t{result.processors});
  }
  for (const auto& [name, cell] : result.described) filling.put(name, cell);
  if (!program.shows_parameters) return;
  for (const auto& p : program.parameters) filling.put(p.name, to_value(p.get(experiment.params)));
}

// Lists the columns of inputs, which precede the measured ones. A row may leave some of them empty.
std::vector<std::string> input_columns(const ExperimentFile& file) {
  auto columns = axis_columns(file);
  const auto add = [&](const std::string& name) {
    if (std::ranges::find(columns, name) == columns.end()) columns.push_back(name);
  };
  for (const auto* program : programs_of(file))
    for (const auto& part : program->parts) add(part);
  return columns;
}

// Converts columns whose numbers are all integral to integers, so that they are written without a
// decimal point.
void make_whole(Table& table) {
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const bool whole = std::ranges::all_of(table.rows, [&](const auto& row) {
      const auto* number = std::get_if<double>(&row[c]);
      return !number || (*number == std::floor(*number) && std::abs(*number) < EXACT);
    });
    for (auto& row : table.rows)
      if (const auto* number = std::get_if<double>(&row[c]); number && whole)
        row[c] = static_cast<std::int64_t>(*number);
  }
}

bool is_base(const Table& table, const std::vector<Value>& base, const std::vector<Value>& row,
             std::size_t processors) {
  const Value one = std::int64_t{1};
  for (std::size_t c = 0; c < table.axes; ++c)
    if (base[c] != (c == processors ? one : row[c])) return false;
  return true;
}

// Fills empty speed-ups by means of the time of the same machine with a single worker.
void add_speedups(Table& table, const Results& results, const std::string& processors) {
  const auto workers = table.find(processors), time = table.find("time_s");
  const auto speedup = table.find("speedup"), efficiency = table.find("efficiency");
  if (!workers || !time || !speedup || !efficiency) return;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    auto& row = table.rows[r];
    const auto& single_s = results[table.points[r]].single_s;
    if (!single_s || row[*speedup] != Value()) continue;
    const double s = *single_s / *as_number(row[*time]);
    row[*speedup] = s;
    row[*efficiency] = s / *as_number(row[*workers]);
  }
}

}  // namespace

const programs::Shows& shows_of(const ExperimentFile& file) {
  static const programs::Shows DEFAULTS;
  const auto all = programs_of(file);
  return all.size() == 1 ? all[0]->shows : DEFAULTS;
}

Value to_value(const Coordinate& at) {
  const toml::node& value = *at.value;
  if (const auto whole = value.value_exact<std::int64_t>()) return *whole;
  const auto number = value.value_exact<double>();
  if (number && std::isfinite(*number)) return *number;
  const auto text = value.value_exact<std::string>();
  return text ? *text : base::to_toml(value);
}

std::vector<std::string> find_coupled(const ExperimentFile& file, const std::string& column) {
  for (const auto& axes : file.sweep) {
    std::vector<std::string> columns;
    for (const auto& axis : axes) columns.push_back(column_of(file, axis.name));
    if (std::ranges::find(columns, column) != columns.end()) return columns;
  }
  return {column};
}

std::vector<std::string> axis_columns(const ExperimentFile& file) {
  auto columns = shows_of(file).leading;
  for (const auto& axis : file.axes()) {
    const auto column = column_of(file, axis.name);
    if (std::ranges::find(columns, column) == columns.end()) columns.push_back(column);
  }
  return columns;
}

std::vector<std::string> declared_columns(const ExperimentFile& file) {
  auto columns = input_columns(file);
  for (const auto* program : programs_of(file)) {
    columns.insert(columns.end(), {"topology", program->processors});
    columns.insert(columns.end(), program->shows.leading.begin(), program->shows.leading.end());
    for (const auto& p : program->parameters) columns.push_back(p.name);
    for (const auto& c : program->columns) columns.push_back(c.name);
  }
  columns.push_back("ended");
  std::ranges::sort(columns);
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  return columns;
}

bool is_declared(const std::vector<std::string>& declared, const std::string& name) {
  return std::ranges::any_of(declared, [&](const std::string& column) {
    const auto at = column.find("{}");
    if (at == column.npos) return column == name;
    return name.size() > column.size() - 2 && name.starts_with(column.substr(0, at)) &&
           name.ends_with(column.substr(at + 2));
  });
}

bool is_complete_row(const Table& table, const std::vector<Value>& row) {
  const auto column = table.find("ended");
  return !column || row[*column] == Value("done") || row[*column] == Value("saturated");
}

void add_speedups(Table& table, const std::string& processors) {
  const auto axis = table.find(processors), time = table.find("time_s");
  const auto speedup = table.find("speedup"), efficiency = table.find("efficiency");
  if (!axis || *axis >= table.axes || !time || !speedup || !efficiency) return;
  for (auto& row : table.rows) {
    if (row[*speedup] != Value()) continue;
    const auto base = std::ranges::find_if(
        table.rows, [&](const auto& other) { return is_base(table, other, row, *axis); });
    if (base == table.rows.end() || !is_complete_row(table, *base) || !is_complete_row(table, row))
      continue;
    const double s = *as_number((*base)[*time]) / *as_number(row[*time]);
    row[*speedup] = s;
    row[*efficiency] = s / *as_number(row[*axis]);
  }
}

void add_serial_fractions(Table& table, const std::string& processors) {
  const auto axis = table.find(processors), speedup = table.find("speedup");
  for (const auto& [name, law] : {std::pair("serial_karp_flatt", &karp_flatt),
                                  std::pair("serial_gustafson", &serial_gustafson)}) {
    const auto column = table.find(name);
    if (!column || !axis || !speedup) return;
    for (auto& row : table.rows) {
      const auto n = as_number(row[*axis]), s = as_number(row[*speedup]);
      if (const auto serial = n && s ? law(*n, *s) : std::nullopt) row[*column] = *serial;
    }
  }
}

namespace {

Table start_table(const ExperimentFile& file) {
  Table table;
  table.columns = input_columns(file);
  table.axes = table.columns.size();
  return table;
}

void add_row(Table& table, const ExperimentFile& file, const Results& results, std::size_t point,
             const base::Row& measured) {
  Filling filling(table);
  filling.begin();
  table.points.push_back(point);
  const Point& at = file.points[point];
  for (const auto& coordinate : at.at)
    filling.put(column_of(file, coordinate.axis), to_value(coordinate));
  put_inputs(filling, at.experiment, results[point]);
  for (const auto& [name, cell] : measured) filling.put(name, cell);
}

}  // namespace

Table make_table_of(std::vector<base::Row> PointResult::*rows, const ExperimentFile& file,
                    const Results& results) {
  Table table = start_table(file);
  for (std::size_t i = 0; i < results.size(); ++i)
    for (const auto& row : results[i].*rows) add_row(table, file, results, i, row);
  return table;
}

Table make_table(const ExperimentFile& file, const Results& results) {
  Table table = start_table(file);
  for (std::size_t i = 0; i < results.size(); ++i) {
    for (const auto& row : results[i].rows) add_row(table, file, results, i, row);
    if (results[i].rows.empty()) add_row(table, file, results, i, {});
  }
  table.columns.push_back("ended");
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    table.rows[r].emplace_back(results[table.points[r]].ended);
  const auto processors = programs_of(file)[0]->processors;
  add_speedups(table, processors);
  add_speedups(table, results, processors);
  add_serial_fractions(table, processors);
  if (programs_of(file)[0]->shows_parameters || programs_of(file).size() > 1) make_whole(table);
  return table;
}

std::set<std::string> input_names(const ExperimentFile& file, const Table& table) {
  std::set<std::string> inputs{"topology", "processors", "workers"};
  for (std::size_t c = 0; c < table.axes; ++c) inputs.insert(table.columns[c]);
  for (const auto* program : programs_of(file))
    for (const auto& p : program->parameters) inputs.insert(p.name);
  return inputs;
}

std::vector<std::string> first_result(const ExperimentFile& file, const Table& table) {
  const auto inputs = input_names(file, table);
  const auto is_leading = [&](const std::string& column) {
    return std::ranges::any_of(programs_of(file), [&](const auto* program) {
      return std::ranges::find(program->shows.leading, column) != program->shows.leading.end();
    });
  };
  for (const auto& column : table.columns)
    if (!inputs.contains(column) && !is_leading(column)) return {column};
  return {};
}

std::vector<programs::UsualPlot> find_common_plots(const ExperimentFile& file) {
  const auto all = programs_of(file);
  auto plots = all[0]->shows.plots;
  for (const auto* program : all)
    std::erase_if(plots, [&](const programs::UsualPlot& plot) {
      return std::ranges::find(program->shows.plots, plot.column, &programs::UsualPlot::column) ==
             program->shows.plots.end();
    });
  return plots;
}

std::vector<std::string> find_histograms(const ExperimentFile& file) {
  std::vector<std::string> all;
  for (const auto* program : programs_of(file))
    for (const auto& quantity : program->shows.histograms)
      if (std::ranges::find(all, quantity) == all.end()) all.push_back(quantity);
  return all;
}

std::optional<programs::SaturationColumns> find_common_saturation(const ExperimentFile& file) {
  const auto all = programs_of(file);
  const auto& first = all[0]->shows.saturation;
  const bool is_common = std::ranges::all_of(
      all, [&](const auto* program) { return program->shows.saturation == first; });
  return is_common ? first : std::nullopt;
}

}  // namespace laboratory
