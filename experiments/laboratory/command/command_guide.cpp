// tlab list, help and init: orientation and first steps.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <set>

#include "base/errors.hpp"
#include "base/message.hpp"
#include "experiments/laboratory/command/commands.hpp"
#include "experiments/laboratory/guide/catalogue.hpp"
#include "experiments/laboratory/guide/keys.hpp"
#include "experiments/laboratory/guide/templates.hpp"
#include "experiments/laboratory/host/streams.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

struct ListOptions {
  std::string kind, folder;
  bool names = false;
};

void list(const ListOptions& o) {
  const bool has_files = o.kind.empty() || o.kind == "experiments" || o.kind == "scenes";
  base::require(o.folder.empty() || has_files, "list",
                "found the folder {} with {}, expected a folder only with experiments or scenes",
                o.folder, o.kind);
  const auto folder = o.folder.empty() ? find_experiments() : std::optional<fs::path>(o.folder);
  std::string text;
  for (const auto& kind : o.kind.empty() ? catalogue_kinds() : std::vector{o.kind}) {
    const auto catalogue = make_catalogue(kind, folder);
    if (o.names)
      for (const auto& entry : catalogue.entries) text += entry.name + "\n";
    else
      text += (text.empty() ? "" : "\n") + to_text(catalogue);
  }
  print_paged(text);
}

void add_list_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "list", "list the available experiments, programs, topologies, models and scenes");
  auto o = std::make_shared<ListOptions>();
  command->add_option("KIND", o->kind, fmt::format("{} [all]", fmt::join(catalogue_kinds(), ", ")));
  command->add_option("FOLDER", o->folder,
                      "folder with experiments and scenes [those installed with tlab]");
  command->add_flag("--names", o->names, "only the names, one per line");
  command->footer("Examples:\n  tlab list\n  tlab list topologies\n  tlab list scenes .");
  command->callback([o] { list(*o); });
}

// Finds the help on the command or program named `word`, or on both if they share the name. The
// word "keys" stands for the keys of all experiment files and programs.
std::string find_help(const CLI::App& app, const std::string& word) {
  if (word == "keys") return describe_keys() + "\n" + describe_programs();
  std::string text;
  std::set<std::string> known{"keys"};
  for (const auto* command : app.get_subcommands({})) {
    known.insert(command->get_name());
    if (command->get_name() == word) text += command->help("tlab");
  }
  for (const auto& program : programs::all_programs()) {
    known.insert(program.name);
    if (program.name != word) continue;
    if (!text.empty()) text += "\nThe program, in an experiment file:\n";
    text += fmt::format("{}\nResults of {}", describe_program(program), describe_columns(program));
  }
  if (text.empty())
    throw base::BadInput(fmt::format("help: found \"{}\"{}", word,
                                     base::suggest(word, {known.begin(), known.end()})));
  return text;
}

std::string find_help(const CLI::App& app, const std::vector<std::string>& words) {
  if (words.empty()) return app.help();
  if (words.size() == 1) return find_help(app, words[0]);
  const auto* program = programs::find_program(words[1]);
  base::require(
      words[0] == "run" && program, "help",
      "found \"{} {}\", expected a command, a program, \"keys\", or \"run\" and a program",
      words[0], words[1]);
  return fmt::format("{}\n{}\nThe program:\n{}", find_help(app, "run"), describe_keys(),
                     describe_program(*program));
}

void add_help_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "help",
      "help on a command, a program (farm, radiosity ...), or the keys of experiment files");
  auto words = std::make_shared<std::vector<std::string>>();
  command->add_option("TOPIC", *words, "a command; a program; run PROGRAM; keys")
      ->expected(0, 2)
      ->option_text("...");
  command->footer(
      "Examples:\n  tlab help run\n  tlab help farm        # its keys and its results\n  tlab help "
      "run farm    # with the keys common to all programs\n  tlab help keys        # all keys of "
      "all programs");
  command->callback([words, &app] { print_paged(find_help(app, *words)); });
}

void add_init_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("init", "create a folder with a commented experiment or a C++ program");
  struct Options {
    std::string name, from = "farm";
  };
  auto o = std::make_shared<Options>();
  command->add_option("NAME", o->name, "name of the new folder and of its files")->required();
  command->add_option("--from", o->from, fmt::format("{}", fmt::join(template_names(), ", ")))
      ->capture_default_str();
  command->footer(
      "Examples:\n  tlab init mine && cd mine && tlab run mine.toml\n  tlab init rings --from "
      "topology");
  command->callback([o] {
    for (const auto& file : start_from_template(o->name, o->from)) print_out("{}\n", file.string());
  });
}

}  // namespace

void add_guide_commands(CLI::App& app) {
  add_list_command(app);
  add_help_command(app);
  add_init_command(app);
}

}  // namespace laboratory
