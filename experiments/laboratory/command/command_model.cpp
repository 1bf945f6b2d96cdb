#include <fmt/format.h>

#include "experiments/laboratory/command/commands.hpp"
#include "simulator/machine/model.hpp"

namespace laboratory {

void add_model_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "model",
      "print a machine model, every parameter with unit and provenance; or how two differ");
  auto names = std::make_shared<std::vector<std::string>>();
  command
      ->add_option("NAME", *names,
                   fmt::format("{} or a model file", fmt::join(machine::builtin_models(), ", ")))
      ->required()
      ->expected(1, 2);
  command->callback([names] {
    const auto model = machine::load_model((*names)[0]);
    fmt::print("{}", names->size() == 1
                         ? machine::describe(model)
                         : machine::describe_difference(model, machine::load_model((*names)[1])));
  });
}

}  // namespace laboratory
