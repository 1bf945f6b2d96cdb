// tlab model: prints a machine model, starts a new one, and fits it to measurements.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>

#include "base/errors.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/calibrate/calibration.hpp"
#include "experiments/laboratory/command/commands.hpp"
#include "experiments/laboratory/host/elapsed_time.hpp"
#include "experiments/laboratory/host/streams.hpp"
#include "experiments/laboratory/options/options.hpp"
#include "simulator/machine/model.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

struct ModelOptions {
  std::vector<std::string> names;
  bool is_new = false;
  std::string base = "t805-25";
  CalibrationTask fit;
  std::string output;
};

// Throws unless the file name is valid for a model: letters, digits, - and _, and not the name of a
// built-in model.
void check_model_file(const std::string& file) {
  const auto name = fs::path(file).stem().string();
  const bool is_name = !name.empty() && std::ranges::all_of(name, [](unsigned char c) {
    return std::isalnum(c) || c == '-' || c == '_';
  });
  base::require(file.ends_with(".toml") && is_name, file,
                "expected a file name NAME.toml, where NAME has only letters, digits, - and _");
  const auto known = machine::builtin_models();
  base::require(std::ranges::find(known, name) == known.end(), file,
                "found the name of a built-in model, expected a new name");
}

void begin_model(const ModelOptions& o) {
  base::require(o.names.size() == 1, "--new", "found {} names, expected one", o.names.size());
  const auto file = o.names[0].ends_with(".toml") ? o.names[0] : o.names[0] + ".toml";
  check_model_file(file);
  base::require(!fs::exists(file), file, "found an existing file, expected a new name");
  base::save_whole(file, make_model_file(o.base, file));
  print_out("model    {}\n", file);
}

void fit_model(ModelOptions o) {
  base::require(o.names.size() == 1, "--fit", "found {} models, expected one", o.names.size());
  o.fit.model = o.names[0];
  if (!o.output.empty()) {
    check_model_file(o.output);
    base::require(!fs::exists(o.output) || is_fitted_model(base::read_own_text(o.output)), o.output,
                  "found a file that --fit has not written, expected a new name");
    base::check_can_save(o.output);
  }
  const auto found = [&] {
    const ElapsedTime elapsed_time("model --fit " + o.fit.measurements);
    return calibrate(o.fit);
  }();
  print_out("{}", to_text(found));
  if (o.output.empty()) return;
  base::save_whole(o.output, to_model_file(found, o.fit, o.output));
  print_out("model    {}\n", o.output);
}

void print_models(const ModelOptions& o) {
  const auto model = machine::load_model(o.names[0]);
  print_out("{}", o.names.size() == 1
                      ? machine::describe(model)
                      : machine::describe_difference(model, machine::load_model(o.names[1])));
}

}  // namespace

void add_model_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "model",
      "print a machine model with units and provenance, compare two models, create one or fit one");
  auto o = std::make_shared<ModelOptions>();
  command
      ->add_option("NAME", o->names,
                   fmt::format("{} or a model file", fmt::join(machine::builtin_models(), ", ")))
      ->required()
      ->expected(1, 2);
  auto* begins = command->add_flag("--new", o->is_new, "create NAME.toml, a model to edit");
  command->add_option("--base", o->base, "base of the new model")
      ->needs(begins)
      ->capture_default_str();
  auto* fits =
      command->add_option("--fit", o->fit.measurements,
                          "CSV file of measurements: columns of keys and one column of a result");
  fits->check(check_file_name)->excludes(begins);
  add_names_option(
      *command, "--entries", [o](auto names) { o->fit.entries = std::move(names); },
      "entries of the model to fit to the measurements")
      ->needs(fits);
  fits->needs("--entries");
  command
      ->add_option("--by", o->fit.experiment,
                   "the measured experiment [the program message: bytes, latency_s]")
      ->check(check_file_name)
      ->needs(fits);
  command->add_option("-o,--output", o->output, "write the fitted model (.toml)")
      ->check(check_file_name)
      ->needs(fits);
  command->footer(
      "Examples:\n  tlab model t805-25\n  tlab model t805-25 t800-20     # their differences\n  "
      "tlab model mine --new --base t805-25\n  tlab model t805-25 --fit latencies.csv --entries "
      "link.one_way_20,channel.operands -o mine.toml");
  command->callback([o] {
    if (o->is_new) return begin_model(*o);
    if (!o->fit.measurements.empty()) return fit_model(*o);
    print_models(*o);
  });
}

}  // namespace laboratory
