#pragma once
// Scripts with which a shell completes the commands, options and names of tlab.
#include <CLI/CLI.hpp>
#include <string>

namespace laboratory {

/// For "bash", "zsh" or "fish": commands and options as the application declares them, with their
/// help where the shell shows it; names as `tlab list --names` gives them when they are asked for;
/// else files. Throws base::BadInput for another shell.
std::string make_completion(const CLI::App& app, const std::string& shell);

/// tlab completion
void add_completion_command(CLI::App& app);

}  // namespace laboratory
