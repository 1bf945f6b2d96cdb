#include <fmt/format.h>

#include <thread>

#include "experiments/commands.hpp"
#include "experiments/experiment.hpp"
#include "experiments/run.hpp"

namespace experiments {

void add_run_command(CLI::App& app) {
  auto* command = app.add_subcommand("run", "run an experiment: one run, or a sweep");
  auto o = std::make_shared<RunOptions>();
  o->jobs = std::max(1u, std::thread::hardware_concurrency());
  command->add_option("EXPERIMENT", o->file, "the experiment file (TOML)")->required();
  auto* output =
      command->add_option("-o,--output", o->output, "results folder [results/EXPERIMENT's name]");
  command->add_option("--set", o->overrides, "key.path=value: replaces a key of the experiment")
      ->allow_extra_args(false);
  command->add_option("--jobs", o->jobs, "points run side by side")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_flag("--profile", o->profile,
                    "print the host time per simulated ray, beyond the kernel");
  std::string keys =
      "Keys of the experiment file (any but those of stage and order can be an axis of [sweep]):\n";
  for (const auto& setting : settings())
    keys += fmt::format("  {:<30} {}\n", setting.key, setting.help);
  command->footer(keys);
  command->callback([o, output] {
    if (output->count() > 0 && o->output.empty())
      throw CLI::ValidationError("--output", "expected the name of a folder");
    run_experiment(*o);
  });
}

}  // namespace experiments
