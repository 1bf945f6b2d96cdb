#pragma once
// The subcommands of tlab that render one picture without a simulated machine.
namespace CLI {
class App;
}

namespace laboratory {

void add_render_command(CLI::App& app);
void add_radiosity_command(CLI::App& app);

}  // namespace laboratory
