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
#include "experiments/laboratory/guide/topics.hpp"
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

// The names of everything that `tlab help` explains: commands, programs, topics and "keys".
std::vector<std::string> help_names(const CLI::App& app) {
  std::set<std::string> names{"keys"};
  for (const auto* command : app.get_subcommands({})) names.insert(command->get_name());
  for (const auto& program : programs::all_programs()) names.insert(program.name);
  for (const auto& topic : topics()) names.insert(topic.name);
  return {names.begin(), names.end()};
}

[[noreturn]] void refuse_topic(const CLI::App& app, const std::string& word) {
  const auto known = help_names(app);
  const auto near = find_near_topics(word, known);
  throw base::BadInput(fmt::format(
      "help: found \"{}\"{}", word,
      near.empty() ? base::suggest(word, known)
                   : fmt::format(", the nearest {} \"{}\"", near.size() == 1 ? "is" : "are",
                                 fmt::join(near, "\", \""))));
}

// Finds the help on a word: on the command, the program and the topic with this name, or on a key
// of the experiment file. The word "keys" stands for all keys.
std::string find_help(const CLI::App& app, const std::string& word) {
  if (word == "keys") return describe_keys() + "\n" + describe_programs();
  std::vector<std::string> parts;
  for (const auto* command : app.get_subcommands({}))
    if (command->get_name() == word) parts.push_back(command->help("tlab"));
  const auto start = [&] { return parts.empty() ? "" : "In an experiment file:\n"; };
  if (const auto* program = programs::find_program(word))
    parts.push_back(fmt::format("{}{}\nResults of {}", start(), describe_program(*program),
                                describe_columns(*program)));
  const bool is_topic = std::ranges::find(topics(), word, &Topic::name) != topics().end();
  if (const auto topic = describe_topic(word); !topic.empty() && (is_topic || parts.empty()))
    parts.push_back(start() + topic);
  if (parts.empty()) refuse_topic(app, word);
  return fmt::format("{}", fmt::join(parts, "\n"));
}

std::string find_help(const CLI::App& app, const std::vector<std::string>& words) {
  if (words.empty())
    return fmt::format(
        "{}\n{}\nPrograms: tlab list programs. Keys: tlab help KEY, tlab help keys.\n", app.help(),
        list_topics());
  if (words.size() == 1) return find_help(app, words[0]);
  const auto* program = programs::find_program(words[1]);
  base::require(
      words[0] == "run" && program, "help",
      "found \"{} {}\", expected a command, a program, a topic, \"keys\", or \"run\" and a program",
      words[0], words[1]);
  return fmt::format("{}\n{}\nThe program:\n{}", app.get_subcommand("run")->help("tlab"),
                     describe_keys(), describe_program(*program));
}

void add_help_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "help", "help on a command, a program (farm ...), a topic (plot, seed ...) or a key");
  struct Options {
    std::vector<std::string> words;
    bool names = false;
  };
  auto o = std::make_shared<Options>();
  command->add_option("TOPIC", o->words, "a command; a program; a topic; a key; run PROGRAM; keys")
      ->expected(0, 2)
      ->option_text("...");
  command->add_flag("--names", o->names, "only the names of all topics, one per line")
      ->excludes("TOPIC");
  command->footer(R"(Examples:
  tlab help             # all commands and topics
  tlab help run
  tlab help plot        # a section of experiment files
  tlab help seed
  tlab help farm        # its keys and its results
  tlab help run farm    # with the keys common to all programs
  tlab help keys        # all keys of all programs)");
  command->callback([o, &app] {
    print_paged(o->names ? fmt::format("{}\n", fmt::join(help_names(app), "\n"))
                         : find_help(app, o->words));
  });
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
