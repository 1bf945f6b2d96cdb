#include "experiments/laboratory/command/completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <map>
#include <memory>
#include <regex>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "experiments/laboratory/host/streams.hpp"

namespace laboratory {
namespace {

using Names = std::vector<std::string>;

// For each command whose arguments are names: the command that lists these names if it is called
// with --names. The arguments of all other commands are files.
const std::map<std::string, std::string> NAMES = {{"topology", "list topologies"},
                                                  {"model", "list models"},
                                                  {"render", "list scenes"},
                                                  {"columns", "list programs"},
                                                  {"help", "help"},
                                                  {"run", "list experiments"},
                                                  {"live", "list experiments"},
                                                  {"verify", "list experiments"}};

std::string names_of(const CLI::App& command) {
  const auto found = NAMES.find(command.get_name());
  return found == NAMES.end() ? "" : fmt::format("tlab {} --names", found->second);
}

// Joins a help text to one line and removes characters that are special to shells.
std::string plain(const std::string& help) {
  return std::regex_replace(help.substr(0, help.find('\n')), std::regex("['\"`\\\\:\\[\\]$]"), "");
}

// The option's names, such as "-o" and "--output". Positional arguments have none.
Names option_names(const CLI::Option& option) {
  Names names;
  for (const auto& name : option.get_snames()) names.push_back("-" + name);
  for (const auto& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

std::string for_bash(const std::vector<const CLI::App*>& commands) {
  Names names;
  std::string options, words;
  for (const auto* command : commands) {
    names.push_back(command->get_name());
    Names own;
    for (const auto* option : command->get_options())
      for (const auto& name : option_names(*option)) own.push_back(name);
    options += fmt::format("      {}) words=\"{}\" ;;\n", command->get_name(), fmt::join(own, " "));
    if (const auto list = names_of(*command); !list.empty())
      words += fmt::format("      {}) mapfile -t known < <({} 2>/dev/null) ;;\n",
                           command->get_name(), list);
  }
  return fmt::format(R"script(# bash completion of tlab; made by: tlab completion bash
_tlab() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} words= known=() files=() name
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    words="{}"
  elif [[ $word == -* ]]; then
    case ${{COMP_WORDS[1]}} in
{}    esac
  else
    case ${{COMP_WORDS[1]}} in
{}    esac
    # Leaves out the parts of a file's name that contains a line end.
    mapfile -t files < <(compgen -f -- "$word")
    for name in "${{files[@]}}"; do
      [ -e "${{name/#\~/$HOME}}" ] && COMPREPLY+=("$name")
    done
  fi
  # No expansion of names: they may hold characters that are special to the shell.
  [ -n "$words" ] && read -r -a known <<< "$words"
  for name in "${{known[@]}}"; do
    [[ $name == "$word"* ]] && COMPREPLY+=("$name")
  done
}}
complete -o filenames -F _tlab tlab
)script",
                     fmt::join(names, " "), options, words);
}

std::string for_zsh(const std::vector<const CLI::App*>& commands) {
  std::string names, cases;
  for (const auto* command : commands) {
    names += fmt::format("    '{}:{}'\n", command->get_name(), plain(command->get_description()));
    cases += fmt::format("    {}) _arguments", command->get_name());
    for (const auto* option : command->get_options())
      for (const auto& name : option_names(*option))
        cases += fmt::format(" \\\n      '{}[{}]{}'", name, plain(option->get_description()),
                             option->get_expected_max() == 0 ? "" : ": :_files");
    const auto list = names_of(*command);
    cases += fmt::format(" \\\n      '*: :{}' ;;\n",
                         list.empty() ? "_files" : "_tlab_names " + NAMES.at(command->get_name()));
  }
  return fmt::format(R"script(#compdef tlab
# zsh completion of tlab; made by: tlab completion zsh
_tlab_names() {{
  local -a names
  names=(${{(f)"$(tlab $@ --names 2>/dev/null)"}})
  compadd -- $names
  _files
}}
_tlab() {{
  local -a commands
  commands=(
{}  )
  if (( CURRENT == 2 )); then
    _describe command commands
    return
  fi
  shift words
  (( CURRENT-- ))
  case $words[1] in
{}  esac
}}
if [ "$funcstack[1]" = _tlab ]; then _tlab "$@"; else compdef _tlab tlab; fi
)script",
                     names, cases);
}

std::string for_fish(const std::vector<const CLI::App*>& commands) {
  std::string lines = "# fish completion of tlab; made by: tlab completion fish\n";
  for (const auto* command : commands) {
    const auto& name = command->get_name();
    lines += fmt::format("complete -c tlab -f -n __fish_use_subcommand -a {} -d '{}'\n", name,
                         plain(command->get_description()));
    const auto where = fmt::format("complete -c tlab -n '__fish_seen_subcommand_from {}'", name);
    for (const auto* option : command->get_options()) {
      if (option_names(*option).empty()) continue;
      lines += where;
      for (const auto& shorter : option->get_snames()) lines += " -s " + shorter;
      for (const auto& longer : option->get_lnames()) lines += " -l " + longer;
      lines += fmt::format("{} -d '{}'\n", option->get_expected_max() == 0 ? "" : " -r",
                           plain(option->get_description()));
    }
    if (const auto list = names_of(*command); !list.empty())
      lines += fmt::format("{} -a '({} 2>/dev/null)'\n", where, list);
  }
  return lines;
}

}  // namespace

std::string make_completion(const CLI::App& app, const std::string& shell) {
  const std::map<std::string, std::string (*)(const std::vector<const CLI::App*>&)> shells = {
      {"bash", &for_bash}, {"zsh", &for_zsh}, {"fish", &for_fish}};
  const auto found = shells.find(shell);
  base::require(found != shells.end(), "completion", "found {}, expected bash, zsh or fish", shell);
  std::vector<const CLI::App*> commands;
  for (const auto* command : app.get_subcommands({})) commands.push_back(command);
  return found->second(commands);
}

void add_completion_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "completion", "print a script that completes tlab's commands and options in a shell");
  auto shell = std::make_shared<std::string>();
  command->add_option("SHELL", *shell, "bash, zsh or fish")->required();
  command->footer(
      "Examples:\n  tlab completion bash > ~/.local/share/bash-completion/completions/tlab\n"
      "  tlab completion fish > ~/.config/fish/completions/tlab.fish");
  command->callback([&app, shell] { print_out("{}", make_completion(app, *shell)); });
}

}  // namespace laboratory
