#pragma once
// Shell completion for the commands, options and names of tlab.
#include <string>

namespace CLI {
class App;
}

namespace laboratory {

/// Makes the completion script for "bash", "zsh" or "fish". It contains the commands and options,
/// with help texts if the shell shows them. It calls `tlab list --names` for names, and completes
/// all other arguments to files. Throws base::BadInput for another shell.
std::string make_completion(const CLI::App& app, const std::string& shell);

/// Adds `tlab completion`.
void add_completion_command(CLI::App& app);

}  // namespace laboratory
