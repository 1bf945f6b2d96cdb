#include <fmt/format.h>

#include <algorithm>

#include "base/errors.hpp"
#include "experiments/laboratory/command/commands.hpp"
#include "simulator/programs/programs.hpp"

namespace laboratory {

namespace {

void print_columns(const programs::Program& program, bool markdown) {
  if (markdown)
    fmt::print("### {}\n\n{}\n\n| column | what it is |\n| --- | --- |\n", program.name,
               program.help);
  else
    fmt::print("{}: {}\n", program.name, program.help);
  for (const auto& [name, help] : program.columns)
    if (markdown)
      fmt::print("| `{}` | {} |\n", name, help);
    else
      fmt::print("  {:<26} {}\n", name, help);
  fmt::print("\n");
}

}  // namespace

void add_columns_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("columns", "print what the columns of a program's results mean");
  struct Options {
    std::string program;
    bool markdown = false;
  };
  auto o = std::make_shared<Options>();
  command->add_option("PROGRAM", o->program, "farm, message, ... [all]");
  command->add_flag("--markdown", o->markdown, "as tables for the manual");
  command->callback([o] {
    if (!o->program.empty() && !programs::find_program(o->program))
      throw base::BadInput(
          fmt::format("columns: found {}, expected a program (tlab run --help)", o->program));
    for (const auto& program : programs::all_programs())
      if (o->program.empty() || o->program == program.name) print_columns(program, o->markdown);
  });
}

}  // namespace laboratory
