#pragma once
// The subcommands of tlab that make one picture, on no machine.
#include <CLI/CLI.hpp>

namespace laboratory {

void add_render_command(CLI::App& app);
void add_radiosity_command(CLI::App& app);

}  // namespace laboratory
