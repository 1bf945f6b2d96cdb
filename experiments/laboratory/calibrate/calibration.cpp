#include "experiments/laboratory/calibrate/calibration.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/errors.hpp"
#include "base/message.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/file/schema.hpp"
#include "experiments/laboratory/file/values.hpp"
#include "experiments/laboratory/host/temporary_folder.hpp"
#include "experiments/laboratory/points/results.hpp"
#include "experiments/laboratory/points/run_point.hpp"
#include "experiments/laboratory/table/least_squares.hpp"
#include "experiments/laboratory/table/statistics.hpp"
#include "simulator/machine/model.hpp"

namespace laboratory {
namespace {

using base::require;
using Texts = std::vector<std::string>;

// Loads the task's experiment file, with its sweep replaced by `sweep` and its machine model by the
// task's model. The path of a model file becomes absolute, because the loader would take a relative
// path from the folder of the experiment file.
ExperimentFile read_task(const CalibrationTask& task, const toml::table& sweep) {
  const auto model =
      task.model.ends_with(".toml") ? std::filesystem::absolute(task.model).string() : task.model;
  const auto none = std::make_shared<toml::array>();
  const Overrides overrides = {{"check", none},
                               {"plot", none},
                               {"best", none},
                               {"run.engine", make_node("direct")},
                               {"machine.model", make_node(model)},
                               {"sweep", std::make_shared<toml::table>(sweep)}};
  if (!task.experiment.empty()) return load_experiment(task.experiment, overrides);
  return load_experiment({"[program]\nname = \"message\"\n", task.measurements, ""}, overrides);
}

// Throws if the experiment overrides entries of the model, because the fitted model file would not
// contain these overrides. Also throws if an axis of the experiment is no column of the
// measurements.
void check_experiment(const CalibrationTask& task, const Texts& columns) {
  if (task.experiment.empty()) return;
  const auto file = load_experiment(task.experiment, {});
  for (const auto& axis : file.axes())
    require(std::ranges::find(columns, axis.name) != columns.end(), task.measurements,
            "found no column {}, expected one, because it is an axis of {}", axis.name,
            task.experiment);
  for (const auto& point : file.points)
    require(point.experiment.model.entries.empty() && point.experiment.others.empty(),
            task.experiment, "found [model] or [[processor]], expected the machine as {} has it",
            task.model);
}

// The measured results, each with the experiment settings under which it was measured.
struct Measurements {
  Table settings;  ///< one row for each measurement: the values of its experiment keys
  std::vector<double> values;
  std::string column;
  Texts unused;
};

bool is_key(const programs::Program& program, const std::string& column) {
  try {
    name_axis(column, {&program}, "");
    return true;
  } catch (const base::BadInput&) {
    return false;
  }
}

// Columns of a file of measurements by number: the experiment keys, and the measured result.
struct MeasuredColumns {
  std::vector<std::size_t> keys;
  std::size_t result = 0;
};

// Finds the columns. Fills the names in `read`.
MeasuredColumns find_columns(const Table& table, const programs::Program& program,
                             const std::string& file, Measurements& read) {
  MeasuredColumns found;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const auto& name = table.columns[c];
    if (std::ranges::find(program.columns, name, &programs::ColumnHelp::name) !=
        program.columns.end()) {
      require(read.column.empty(), file, "found the results {} and {}, expected one", read.column,
              name);
      found.result = c;
      read.column = name;
    } else if (is_key(program, name)) {
      found.keys.push_back(c);
      read.settings.columns.push_back(name);
    } else {
      read.unused.push_back(name);
    }
  }
  require(
      !read.column.empty(), file,
      "found the columns {}, expected one that is a result of the program {} (see tlab columns {})",
      join_texts(table.columns, ", "), program.name, program.name);
  require(!found.keys.empty(), file,
          "found the columns {}, expected at least one key of the experiment (see tlab help {})",
          join_texts(table.columns, ", "), program.name);
  return found;
}

Measurements read_measurements(const CalibrationTask& task) {
  const auto& file = task.measurements;
  const auto table = parse_csv(base::read_text(file), file);
  check_experiment(task, table.columns);
  Measurements read;
  const auto columns =
      find_columns(table, *read_task(task, {}).points[0].experiment.program, file, read);
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const auto& row = table.rows[r];
    const auto value = as_number(unquote_number(row[columns.result]));
    require(value && std::isfinite(*value) && *value > 0,
            fmt::format("{}:{}: {}", file, table.lines[r], read.column),
            "found {}, expected a number above 0", to_string(row[columns.result]));
    read.values.push_back(*value);
    auto& setting = read.settings.rows.emplace_back();
    for (const auto key : columns.keys) setting.push_back(unquote_number(row[key]));
  }
  require(read.values.size() > task.entries.size(), file,
          "found {} measurement(s) for {} entries, expected more measurements than entries",
          read.values.size(), task.entries.size());
  read.settings.lines = table.lines;
  return read;
}

void push_back(toml::array& list, const Value& value) {
  const auto any = as_number(value);
  const auto cell = any ? to_cell(*any) : value;
  if (const auto* whole = std::get_if<std::int64_t>(&cell))
    list.push_back(*whole);
  else if (const auto* number = std::get_if<double>(&cell))
    list.push_back(*number);
  else
    list.push_back(to_string(cell));
}

// Makes a sweep with one point for each distinct row of `settings`. Fills `which` with the number
// of the sweep's point, from 0, for each measurement.
toml::table make_sweep(const Table& settings, std::vector<std::size_t>& which) {
  std::vector<std::vector<Value>> points;
  toml::array values;
  for (const auto& row : settings.rows) {
    const auto known = std::ranges::find_if(
        points, [&](const auto& point) { return std::ranges::equal(point, row, is_same); });
    which.push_back(static_cast<std::size_t>(known - points.begin()));
    if (known != points.end()) continue;
    points.push_back(row);
    toml::array point;
    for (const auto& cell : row) push_back(row.size() > 1 ? point : values, cell);
    if (row.size() > 1) values.push_back(std::move(point));
  }
  toml::table sweep;
  sweep.insert(join_texts(settings.columns, ", "), std::move(values));
  return sweep;
}

// Reads the experiment with all measured settings. If a setting is refused, names its line in the
// file of measurements.
ExperimentFile read_settings(const CalibrationTask& task, const Table& settings,
                             std::vector<std::size_t>& which) {
  try {
    auto file = read_task(task, make_sweep(settings, which));
    for (const auto& point : file.points) check_point(point.experiment);
    return file;
  } catch (const base::BadInput&) {
    for (std::size_t r = 0; settings.rows.size() > 1 && r < settings.rows.size(); ++r) {
      std::vector<std::size_t> only;
      try {
        read_settings(task, {.columns = settings.columns, .rows = {settings.rows[r]}}, only);
      } catch (const base::BadInput& error) {
        constexpr std::string_view MARK = ", with --set: ";
        std::string_view reason = error.what();
        if (const auto at = reason.find(MARK); at != reason.npos)
          reason.remove_prefix(at + MARK.size());
        base::refuse(fmt::format("{}:{}", task.measurements, settings.lines[r]), "{}", reason);
      }
    }
    throw;
  }
}

// Simulates all measured settings with given values of the model's entries.
class Runs {
 public:
  Runs(const CalibrationTask& task, const Measurements& measured)
      : column_(measured.column), file_(read_settings(task, measured.settings, which_)) {}

  /// Returns the simulated result for each measurement.
  const std::vector<double>& eval(const Texts& entries, const std::vector<double>& values) {
    if (values == values_) return given_;
    Results results;
    ExperimentFile changed = file_;
    for (auto& point : changed.points) {
      for (std::size_t i = 0; i < entries.size(); ++i)
        point.experiment.model.entries.emplace_back(entries[i], values[i]);
      results.push_back(run_point(point, {}, images_.path()));
    }
    const auto table = make_table(changed, results);
    given_.clear();
    for (const auto point : which_) {
      const auto found = as_number(table.rows[table.row_of(point)][*table.find(column_)]);
      require(found && *found > 0, name_of(file_.points[point]),
              "found no {} above 0 from the model, expected one", column_);
      given_.push_back(*found);
    }
    values_ = values;
    return given_;
  }

 private:
  std::vector<std::size_t> which_;
  std::string column_;
  ExperimentFile file_;
  TemporaryFolder images_;
  std::vector<double> values_, given_;  // model entries of the last call of eval(), and its results
};

const machine::Entry& find_entry(const machine::Model& model, const std::string& key) {
  const auto found = std::ranges::find(model.entries, key, &machine::Entry::key);
  if (found == model.entries.end()) {
    Texts known;
    for (const auto& entry : model.entries) known.push_back(entry.key);
    base::refuse("--entries", "found {}, expected an entry of {}{}", key, model.name,
                 base::did_you_mean(key, known));
  }
  require(found->value > 0, "--entries", "found {} with the value {}, expected a value above 0",
          key, found->value);
  return *found;
}

std::string describe_undetermined(const Undetermined& error, const CalibrationTask& task) {
  if (error.parameters.size() == 1)
    return fmt::format("found no measurement that depends on {}, expected at least one",
                       task.entries[error.parameters[0]]);
  return fmt::format(
      "found that {} and {} change all measurements in the same proportion, expected measurements "
      "that distinguish them",
      task.entries[error.parameters[0]], task.entries[error.parameters[1]]);
}

Table compare(const Measurements& measured, const std::vector<double>& given) {
  Table table = measured.settings;
  table.axes = table.columns.size();
  for (const char* what : {"measured", "fitted"})
    table.columns.push_back(fmt::format("{} {}", what, measured.column));
  table.columns.push_back("error %");
  for (std::size_t i = 0; i < given.size(); ++i) {
    auto& row = table.rows[i];
    row.emplace_back(fmt::format("{:.4g}", measured.values[i]));
    row.emplace_back(fmt::format("{:.4g}", given[i]));
    row.emplace_back(fmt::format("{:+.2f}", 100 * (given[i] / measured.values[i] - 1)));
  }
  return table;
}

// The fit works on logarithms of the entries, because entries are positive and simulated results
// are roughly proportional to them. An entry may change by at most this factor.
constexpr double MOST_FACTOR = 1e4;

using Entries = std::vector<const machine::Entry*>;

Entries find_entries(const machine::Model& model, const Texts& keys) {
  Entries entries;
  for (const auto& key : keys) {
    require(std::ranges::count(keys, key) == 1, "--entries", "found {} twice", key);
    entries.push_back(&find_entry(model, key));
  }
  require(!entries.empty(), "--entries", "found none, expected the entries to fit");
  return entries;
}

// Values of the entries from their logarithms. `start` has the logarithms before the fit.
std::vector<double> to_values(const std::vector<double>& logarithms,
                              const std::vector<double>& start) {
  std::vector<double> values;
  for (std::size_t i = 0; i < start.size(); ++i)
    values.push_back(std::exp(std::clamp(logarithms[i], start[i] - std::log(MOST_FACTOR),
                                         start[i] + std::log(MOST_FACTOR))));
  return values;
}

// Step of the numerical derivative, as a difference of logarithms: the fraction SHARE of the
// entry's value, but at least CYCLES for an entry in cycles. The simulated machine rounds to whole
// cycles, so a smaller change might have no effect.
double eval_step(const machine::Entry& entry, double logarithm) {
  constexpr double SHARE = 0.02, CYCLES = 20;
  const double value = std::exp(logarithm);
  return std::log1p(entry.unit == "cycles" ? std::max(SHARE, CYCLES / value) : SHARE);
}

LeastSquares fit_entries(const CalibrationTask& task, const Measurements& measured, Runs& runs,
                         const Entries& entries, const std::vector<double>& start) {
  const auto residuals = [&](const std::vector<double>& logarithms) {
    auto given = runs.eval(task.entries, to_values(logarithms, start));
    for (std::size_t i = 0; i < given.size(); ++i)
      given[i] = std::log(given[i] / measured.values[i]);
    return given;
  };
  try {
    return fit_least_squares(residuals, start, [&](std::size_t i, double value) {
      return eval_step(*entries[i], value);
    });
  } catch (const Undetermined& error) {
    base::refuse(task.measurements, "{}", describe_undetermined(error, task));
  } catch (const Unsettled&) {
    base::refuse(task.measurements, "found no best values of {}: the fit does not converge",
                 join_texts(task.entries, ", "));
  }
}

}  // namespace

Calibration calibrate(const CalibrationTask& task) {
  const auto model = machine::load_model(task.model);
  const auto entries = find_entries(model, task.entries);
  const auto measured = read_measurements(task);
  Runs runs(task, measured);
  std::vector<double> start;
  for (const auto* entry : entries) start.push_back(std::log(entry->value));
  const auto fit = fit_entries(task, measured, runs, entries, start);
  const auto count = static_cast<double>(measured.values.size());
  Calibration found;
  found.column = measured.column;
  found.unused = measured.unused;
  found.rms = std::sqrt(fit.squares / count);
  const double t = student_t(0.975, count - static_cast<double>(entries.size()));
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const auto& entry = *entries[i];
    const double value = std::exp(fit.parameters[i]), factor = std::exp(t * fit.errors[i]);
    require(std::isfinite(factor) && std::abs(fit.parameters[i] - start[i]) < std::log(MOST_FACTOR),
            task.measurements,
            "found no value of {} that fits the measurements, within a factor of {:g}", entry.key,
            MOST_FACTOR);
    found.entries.push_back(
        {entry.key, entry.unit, entry.value, value, value / factor, value * factor});
  }
  found.compared = compare(measured, runs.eval(task.entries, to_values(fit.parameters, start)));
  return found;
}

std::string to_text(const Calibration& c) {
  Table entries{
      .columns = {"entry", "before", "fitted", "95 % from", "to", "unit"}, .axes = 1, .rows = {}};
  for (const auto& e : c.entries)
    entries.rows.push_back({e.key, fmt::format("{:.6g}", e.before), fmt::format("{:.6g}", e.value),
                            fmt::format("{:.6g}", e.low), fmt::format("{:.6g}", e.high), e.unit});
  std::string text = fmt::format("{}\n{}\nroot mean square of the errors: {:.2g} %\n",
                                 to_text(entries), to_text(c.compared), 100 * c.rms);
  if (!c.unused.empty())
    text += fmt::format("not used: {} (neither keys nor results)\n", join_texts(c.unused, ", "));
  return text;
}

}  // namespace laboratory
