#include <fmt/format.h>

#include "experiments/commands.hpp"
#include "simulator/machine/model.hpp"

namespace experiments {

void add_model_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("model", "print a machine model: every parameter, unit and provenance");
  auto name = std::make_shared<std::string>();
  command
      ->add_option("NAME", *name,
                   fmt::format("{} or a model file", fmt::join(machine::builtin_models(), ", ")))
      ->required();
  command->callback([name] { fmt::print("{}", machine::describe(machine::load_model(*name))); });
}

}  // namespace experiments
