#pragma once
// Shell scripts that complete the commands, options and names of tlab.
#include <CLI/CLI.hpp>
#include <string>

namespace laboratory {

/// The script for "bash", "zsh" or "fish". It contains commands and options, with help if the shell
/// shows it, and calls `tlab list --names` for names; everything else completes to files. Throws
/// base::BadInput for another shell.
std::string make_completion(const CLI::App& app, const std::string& shell);

/// Adds `tlab completion`.
void add_completion_command(CLI::App& app);

}  // namespace laboratory
