#pragma once
// Shell completion for the commands, options and names of tlab.
#include <string>

namespace CLI {
class App;
}

namespace laboratory {

/// Makes the completion script for the shell "bash", "zsh" or "fish". The script lists commands and
/// options, with help texts if the shell can show them. It calls `tlab list --names` to complete
/// names, and completes all other arguments as files. Throws base::BadInput for another shell.
std::string make_completion(const CLI::App& app, const std::string& shell);

/// Adds the command `tlab completion`.
void add_completion_command(CLI::App& app);

}  // namespace laboratory
