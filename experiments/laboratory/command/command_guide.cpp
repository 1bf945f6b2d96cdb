// tlab list, help and init: finding one's way, and beginning.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "base/errors.hpp"
#include "base/message.hpp"
#include "experiments/laboratory/command/commands.hpp"
#include "experiments/laboratory/guide/catalogue.hpp"
#include "experiments/laboratory/guide/keys.hpp"
#include "experiments/laboratory/guide/templates.hpp"
#include "experiments/laboratory/host/pager.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

struct ListOptions {
  std::string kind, folder;
  bool names = false;
};

void list(const ListOptions& o) {
  const auto folder = o.folder.empty() ? find_experiments() : std::optional<fs::path>(o.folder);
  std::string text;
  for (const auto& kind : catalogue_kinds()) {
    if (!o.kind.empty() && o.kind != kind) continue;
    const auto catalogue = make_catalogue(kind, folder);
    if (o.names)
      for (const auto& entry : catalogue.entries) text += entry.name + "\n";
    else
      text += (text.empty() ? "" : "\n") + to_text(catalogue);
  }
  if (text.empty()) make_catalogue(o.kind, folder);  // refuses an unknown kind
  print_paged(text);
}

void add_list_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "list", "what there is to choose from: experiments, programs, topologies, models, scenes");
  auto o = std::make_shared<ListOptions>();
  command->add_option("KIND", o->kind, fmt::format("{} [all]", fmt::join(catalogue_kinds(), ", ")));
  command->add_option("FOLDER", o->folder,
                      "where experiments and scenes are looked for [those that come with tlab]");
  command->add_flag("--names", o->names, "only the names, one a line");
  command->footer("Examples:\n  tlab list\n  tlab list topologies\n  tlab list scenes .");
  command->callback([o] { list(*o); });
}

// The help on what these words name: a command, a program, or the keys of the experiment file.
std::string find_help(const CLI::App& app, const std::vector<std::string>& words) {
  if (words.empty()) return app.help();
  std::string text;
  std::vector<std::string> known{"keys"};
  for (const auto* command : app.get_subcommands({})) known.push_back(command->get_name());
  for (const auto& program : programs::all_programs()) known.push_back(program.name);
  const bool is_run = words.size() == 2 && words[0] == "run";
  for (const auto& word : words) {
    const auto* program = programs::find_program(word);
    const auto commands =
        app.get_subcommands([&](const CLI::App* command) { return command->get_name() == word; });
    if (program)
      text +=
          fmt::format("{}\nResults of {}", describe_program(*program), describe_columns(*program));
    else if (is_run && word == "run")
      text += describe_keys() + "\n";
    else if (!commands.empty())
      text += commands[0]->help("tlab");
    else if (word == "keys")
      text += describe_keys() + "\n" + describe_programs();
    else
      throw base::BadInput(fmt::format("help: found \"{}\"{}", word, base::suggest(word, known)));
  }
  return text;
}

void add_help_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "help",
      "help on a command, a program (farm, radiosity ...), or the keys of experiment files");
  auto words = std::make_shared<std::vector<std::string>>();
  command->add_option("TOPIC", *words, "a command; a program; run PROGRAM; keys")->expected(0, 2);
  command->footer(
      "Examples:\n  tlab help run\n  tlab help farm        # its keys and its results\n  tlab help "
      "run farm    # with the keys that all programs have\n  tlab help keys        # all keys of "
      "all "
      "programs");
  command->callback([words, &app] { print_paged(find_help(app, *words)); });
}

void add_init_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("init", "begin: a folder with a commented experiment, or a C++ program");
  struct Options {
    std::string name, from = "farm";
  };
  auto o = std::make_shared<Options>();
  command->add_option("NAME", o->name, "the folder to make; its files are called so too")
      ->required();
  command->add_option("--from", o->from, fmt::format("{}", fmt::join(template_names(), ", ")))
      ->capture_default_str();
  command->footer(
      "Examples:\n  tlab init mine && cd mine && tlab run mine.toml\n  tlab init rings --from "
      "topology");
  command->callback([o] {
    for (const auto& file : start_from_template(o->name, o->from))
      fmt::print("{}\n", file.string());
  });
}

}  // namespace

void add_guide_commands(CLI::App& app) {
  add_list_command(app);
  add_help_command(app);
  add_init_command(app);
}

}  // namespace laboratory
