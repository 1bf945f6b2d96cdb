#include <thread>

#include "experiments/laboratory/command/commands.hpp"
#include "experiments/laboratory/command/verify.hpp"

namespace laboratory {

void add_verify_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("verify", "compare experiments with their formulas and references");
  auto o = std::make_shared<VerifyOptions>();
  o->jobs = std::max(1u, std::thread::hardware_concurrency());
  command->add_option("PATH", o->paths, "experiment files (TOML), or folders of them")->required();
  auto* output =
      command->add_option("-o,--output", o->output,
                          "results folder of one file, else the folder of all results [results]");
  command->add_option("--set", o->overrides, "key.path=value: replaces a key of each experiment")
      ->allow_extra_args(false);
  command->add_option("--jobs", o->jobs, "points run side by side")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_flag("--all", o->all, "show every point, and not only the worst of many");
  command->callback([o, output] {
    if (output->count() > 0 && o->output.empty())
      throw CLI::ValidationError("--output", "expected the name of a folder");
    verify(*o);
  });
}

}  // namespace laboratory
