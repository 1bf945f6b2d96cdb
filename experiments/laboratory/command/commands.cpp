#include "experiments/laboratory/command/commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/command/run.hpp"
#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/host/version.hpp"
#include "experiments/laboratory/report/run_report.hpp"
#include "simulator/machine/model.hpp"
#include "simulator/programs/programs.hpp"
#include "topologies/draw/graphviz.hpp"
#include "topologies/files/formats.hpp"
#include "topologies/make/generators.hpp"

namespace laboratory {
namespace {

void add_topology_command(CLI::App& app) {
  using Write = std::string (*)(const topologies::Topology&);
  static const std::vector<std::pair<std::string, Write>> FORMATS = {
      {"metrics", topologies::to_metrics},
      {"dot", topologies::to_dot},
      {"graphml", topologies::to_graphml},
      {"svg", topologies::to_svg},
      {"csv", topologies::to_csv}};
  struct Options {
    std::string spec, format = "metrics", output;
  };
  auto* command = app.add_subcommand("topology", "print the metrics of a topology, or export it");
  auto o = std::make_shared<Options>();
  std::string forms;
  for (const auto& g : topologies::generators()) forms += g.form + ", ";
  command->add_option("SPEC", o->spec, forms + "or a .dot, .gv or .graphml file")->required();
  command->add_option("--format", o->format, "what to print")
      ->check(CLI::IsMember(FORMATS))
      ->capture_default_str();
  command->add_option("-o,--output", o->output, "write to this file");
  command->callback([o] {
    const auto format =
        std::ranges::find(FORMATS, o->format, &decltype(FORMATS)::value_type::first);
    const auto text = format->second(topologies::make_topology(o->spec));
    if (o->output.empty())
      fmt::print("{}", text);
    else
      base::save_whole(o->output, text);
  });
}

void add_folder_command(CLI::App& app, const char* name, const char* help,
                        void (*action)(const std::string&)) {
  auto* command = app.add_subcommand(name, help);
  auto folder = std::make_shared<std::string>();
  command->add_option("DIR", *folder, "a results folder")->required();
  command->callback([folder, action] { action(*folder); });
}

void add_model_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "model",
      "print a machine model, every parameter with unit and provenance; or how two differ");
  auto names = std::make_shared<std::vector<std::string>>();
  command
      ->add_option("NAME", *names,
                   fmt::format("{} or a model file", fmt::join(machine::builtin_models(), ", ")))
      ->required()
      ->expected(1, 2);
  command->callback([names] {
    const auto model = machine::load_model((*names)[0]);
    fmt::print("{}", names->size() == 1
                         ? machine::describe(model)
                         : machine::describe_difference(model, machine::load_model((*names)[1])));
  });
}

void print_columns(const programs::Program& program, bool markdown) {
  if (markdown)
    fmt::print("### {}\n\n{}\n\n| column | what it is |\n| --- | --- |\n", program.name,
               program.help);
  else
    fmt::print("{}: {}\n", program.name, program.help);
  for (const auto& [name, help] : program.columns)
    if (markdown)
      fmt::print("| `{}` | {} |\n", name, help);
    else
      fmt::print("  {:<26} {}\n", name, help);
  fmt::print("\n");
}

void add_columns_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("columns", "print what the columns of a program's results mean");
  struct Options {
    std::string program;
    bool markdown = false;
  };
  auto o = std::make_shared<Options>();
  command->add_option("PROGRAM", o->program, "farm, message, ... [all]");
  command->add_flag("--markdown", o->markdown, "as tables for the manual");
  command->callback([o] {
    base::require(o->program.empty() || programs::find_program(o->program), "columns",
                  "found {}, expected a program (tlab run --help)", o->program);
    for (const auto& program : programs::all_programs())
      if (o->program.empty() || o->program == program.name) print_columns(program, o->markdown);
  });
}

void check_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> known;
  for (const auto* command : app.get_subcommands({})) known.push_back(command->get_name());
  if (std::ranges::find(known, argv[1]) != known.end()) return;
  throw base::BadInput(
      fmt::format("unknown command \"{}\", expected one of {} (did you mean \"{}\"?)", argv[1],
                  fmt::join(known, ", "), base::nearest_name(argv[1], known)));
}

}  // namespace

int run_tlab(int argc, char** argv) {
  CLI::App app("tlab, the transputer laboratory: simulates transputer machines that ray trace");
  app.set_version_flag("--version", fmt::format("tlab {}", VERSION));
  app.require_subcommand(1);
  add_topology_command(app);
  add_render_command(app);
  add_radiosity_command(app);
  add_run_command(app);
  add_folder_command(app, "merge", "write the results of points that `run --point` has recorded",
                     &merge_results);
  add_folder_command(app, "report", "make plots and report.html of results again", &report_results);
  add_verify_command(app);
  add_model_command(app);
  add_columns_command(app);
  try {
    check_command(app, argc, argv);
    app.parse(argc, argv);
    if (std::fflush(stdout) != 0)
      throw std::system_error(errno, std::generic_category(), "cannot write standard output");
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "tlab: the host is out of memory\n");
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "tlab: {}\n", error.what());
    return exit_code_of(error);
  }
}

}  // namespace laboratory
