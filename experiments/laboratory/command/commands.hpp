#pragma once
// The subcommands of tlab. Each function declares the options of a subcommand and the action that
// they configure. Subcommands with little code are in commands.cpp.
#include <functional>

namespace CLI {
class App;
}

namespace laboratory {

void add_run_command(CLI::App& app);
void add_live_command(CLI::App& app);
void add_verify_command(CLI::App& app);
void add_compare_command(CLI::App& app);
void add_model_command(CLI::App& app);
void add_convert_command(CLI::App& app);
void add_guide_commands(CLI::App& app);  ///< adds the commands list, help and init

/// Calls `prepare`, then parses and executes the command line. Returns the exit code of the
/// program:
///   - 0: success;
///   - 1: a check or a simulation failed;
///   - 2: bad input or usage;
///   - 3: the simulated program deadlocked, ran out of memory, or did what the machine forbids;
///   - 130: interrupted by the user.
int run_tlab(int argc, char** argv, const std::function<void()>& prepare = {});

}  // namespace laboratory
