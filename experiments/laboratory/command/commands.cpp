#include "experiments/laboratory/command/commands.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <filesystem>
#include <map>
#include <sstream>
#include <system_error>

#include "base/early_end.hpp"
#include "base/errors.hpp"
#include "base/host_program.hpp"
#include "base/message.hpp"
#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/command/completion.hpp"
#include "experiments/laboratory/command/help.hpp"
#include "experiments/laboratory/command/run.hpp"
#include "experiments/laboratory/figure/pdf.hpp"
#include "experiments/laboratory/guide/keys.hpp"
#include "experiments/laboratory/host/elapsed_time.hpp"
#include "experiments/laboratory/host/error_text.hpp"
#include "experiments/laboratory/host/interrupt.hpp"
#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/host/streams.hpp"
#include "experiments/laboratory/host/version.hpp"
#include "experiments/laboratory/options/options.hpp"
#include "experiments/laboratory/picture/picture_commands.hpp"
#include "experiments/laboratory/report/run_report.hpp"
#include "simulator/programs/programs.hpp"
#include "topologies/draw/drawing.hpp"
#include "topologies/files/formats.hpp"
#include "topologies/make/generators.hpp"
#include "topologies/route/given_routes.hpp"

namespace laboratory {
namespace {

// Chooses the output format: the format that the user asked for, or else the format of the output
// file's extension. Throws if the two formats differ.
std::string choose_format(const std::string& asked, const std::string& file) {
  static const std::map<std::string, std::string> ENDINGS = {
      {".dot", "dot"}, {".gv", "dot"},  {".graphml", "graphml"},
      {".svg", "svg"}, {".pdf", "pdf"}, {".csv", "csv"}};
  const auto ending = base::to_lower(std::filesystem::path(file).extension().string());
  const auto said = ENDINGS.find(ending);
  if (said == ENDINGS.end()) {
    base::require(
        !asked.empty() || ending.empty() || ending == ".txt", "-o " + file,
        "found another ending, expected .svg, .pdf, .dot, .gv, .graphml or .csv, or --format");
    return asked.empty() ? "metrics" : asked;
  }
  base::require(asked.empty() || asked == said->second, "-o " + file,
                "found a name for {}, expected one for {}", said->second, asked);
  return said->second;
}

using WriteTopology = std::string (*)(const topologies::Topology&, const base::FigureStyle&);
const std::vector<std::pair<std::string, WriteTopology>> FORMATS = {
    {"metrics", [](auto& topology, auto&) { return topologies::to_metrics(topology); }},
    {"dot", [](auto& topology, auto&) { return topologies::to_dot(topology); }},
    {"graphml", [](auto& topology, auto&) { return topologies::to_graphml(topology); }},
    {"svg", topologies::to_svg},
    {"pdf",
     [](auto& topology, auto& style) {
       return svg_to_pdf(topologies::to_svg(topology, style), topology.name);
     }},
    {"csv", [](auto& topology, auto&) { return topologies::to_csv(topology); }}};

struct TopologyOptions {
  std::string spec, format, routes, output;
  FigureSpec figure;
};

void write_topology(const TopologyOptions& o) {
  const auto format = choose_format(o.format, o.output);
  base::require(o.routes.empty() || format == "metrics", "--routes",
                "found --format {}, expected metrics: other formats contain no routes", format);
  base::require(!o.figure.is_given() || format == "svg" || format == "pdf",
                "--width, --font, --font-size", "found --format {}, expected svg or pdf", format);
  const auto write =
      std::ranges::find(FORMATS, format, &decltype(FORMATS)::value_type::first)->second;
  const auto text = [&] {
    const ElapsedTime elapsed_time(fmt::format("topology {}", o.spec));
    const auto topology = topologies::make_topology(o.spec);
    return o.routes.empty()
               ? write(topology, o.figure.make_style({}))
               : topologies::to_metrics(topology, topologies::find_routes(topology, o.routes));
  }();
  if (o.output.empty())
    isatty(STDOUT_FILENO) == 1 ? print_out("{}", text) : write_output(text);
  else
    base::save_whole(o.output, text);
}

void add_topology_command(CLI::App& app) {
  auto* command = app.add_subcommand("topology", "print the metrics of a topology, or export it");
  auto o = std::make_shared<TopologyOptions>();
  std::string forms;
  for (const auto& g : topologies::generators()) forms += g.form + ", ";
  command->add_option("SPEC", o->spec, forms + "or a .dot, .gv or .graphml file")->required();
  base::Domain formats{base::Domain::Kind::choice};
  for (const auto& [name, write] : FORMATS) formats.choices.push_back(name);
  command
      ->add_option("--format", o->format,
                   "output format [metrics, or the format of the file's ending]")
      ->check(check_value(formats))
      ->option_text(fmt::format("{}", fmt::join(formats.choices, "|")));
  command
      ->add_option("--routes", o->routes,
                   "routes to measure instead of the shortest: xy, or a CSV file from,to,path")
      ->check(check_file_name);
  command->add_option("-o,--output", o->output, "write to this file")->check(check_file_name);
  add_figure_options(*command, o->figure);
  command->footer(
      "Examples:\n  tlab topology torus:4x4\n  tlab topology tree:13 --format svg -o tree.svg\n  "
      "tlab topology tree:13 -o tree.pdf --width column\n  "
      "tlab topology mesh:8x8 --routes xy");
  command->callback([o] { write_topology(*o); });
}

void add_folder_command(CLI::App& app, const char* name, const char* help,
                        void (*action)(const std::string&)) {
  auto* command = app.add_subcommand(name, help);
  auto folder = std::make_shared<std::string>();
  command->add_option("DIR", *folder, "a results folder")->required();
  command->footer(fmt::format("Examples:\n  tlab {} results/farm", name));
  command->callback([folder, action] { action(*folder); });
}

std::string columns_in_markdown(const programs::Program& program) {
  std::string text = fmt::format("### {}\n\n{}\n\n| column | meaning |\n| --- | --- |\n",
                                 program.name, program.help);
  for (const auto& [name, help] : program.columns)
    text += fmt::format("| `{}` | {} |\n", name, help);
  return text;
}

void add_columns_command(CLI::App& app) {
  auto* command = app.add_subcommand("columns", "explain the columns of a program's results");
  struct Options {
    std::string program;
    bool markdown = false;
  };
  auto o = std::make_shared<Options>();
  command->add_option("PROGRAM", o->program, "farm, message, ... [all]");
  command->add_flag("--markdown", o->markdown, "print Markdown tables");
  command->footer("Examples:\n  tlab columns farm");
  command->callback([o] {
    base::require(o->program.empty() || programs::find_program(o->program), "columns",
                  "found {}, expected a program (tlab list programs)", o->program);
    for (const auto& program : programs::all_programs())
      if (o->program.empty() || o->program == program.name)
        print_out("{}\n", o->markdown ? columns_in_markdown(program) : describe_columns(program));
  });
}

void check_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || (argv[1][0] == '-' && app.get_option_no_throw(argv[1]))) return;
  std::vector<std::string> known;
  for (const auto* command : app.get_subcommands({})) known.push_back(command->get_name());
  if (std::ranges::find(known, argv[1]) != known.end()) return;
  throw base::BadInput(fmt::format("unknown command \"{}\", expected one of {}{}", argv[1],
                                   fmt::join(known, ", "), base::did_you_mean(argv[1], known)));
}

void add_report_command(CLI::App& app) {
  auto* command = app.add_subcommand("report", "draw the plots and report.html of results again");
  struct Options {
    std::string folder;
    std::vector<std::string> columns;
    FigureSpec figure;
  };
  auto o = std::make_shared<Options>();
  command->add_option("DIR", o->folder, "folder of results")->required();
  add_names_option(
      *command, "--columns", [o](auto names) { o->columns = std::move(names); }, COLUMNS_HELP);
  add_figure_options(*command, o->figure);
  command->footer(
      "Examples:\n  tlab report results/farm --columns time_s,speedup\n  tlab report results/farm "
      "--width column --font 'DejaVu Serif' --font-size 9");
  command->callback([o] { report_results(o->folder, o->columns, o->figure); });
}

void add_commands(CLI::App& app) {
  app.set_version_flag("--version", describe_version());
  app.require_subcommand(1);
  add_topology_command(app);
  add_render_command(app);
  add_radiosity_command(app);
  add_run_command(app);
  add_live_command(app);
  add_folder_command(app, "merge", "write the results of points recorded by `run --point`",
                     &merge_results);
  add_report_command(app);
  add_verify_command(app);
  add_compare_command(app);
  add_model_command(app);
  add_convert_command(app);
  add_columns_command(app);
  add_guide_commands(app);
  add_completion_command(app);
}

int do_command(CLI::App& app, int argc, char** argv) {
  try {
    check_command(app, argc, argv);
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError& error) {  // CLI11 throws an exception for --help too
    std::ostringstream out, problems;
    const bool is_help = app.exit(error, out, problems) == 0;
    print_out("{}", out.str());
    print_on_error(base::make_readable(problems.str()));
    return is_help ? 0 : EXIT_INPUT;
  }
}

// True if the error means that the reader of our output pipe has closed the pipe.
bool is_broken_pipe(const std::exception& error) {
  const auto* failed = dynamic_cast<const std::system_error*>(&error);
  return failed && failed->code() == std::errc::broken_pipe;
}

}  // namespace

int run_tlab(int argc, char** argv, const std::function<void()>& prepare) try {
  secure_streams();
  secure_memory();
  secure_stack();
  base::ignore_font_settings();
  const InterruptWatch watch;
  const base::InputGuard inputs;
  try {
    if (prepare) prepare();
    CLI::App app("tlab, the transputer laboratory: simulates transputer machines that ray trace");
    app.formatter(std::make_shared<Help>());
    add_commands(app);
    const int exit_code = do_command(app, argc, argv);
    flush_output();
    return exit_code;
  } catch (const std::exception& error) {
    wait_for_error_stream();  // a signal may end the program during this wait
    const base::Undivided last_words;
    if (is_broken_pipe(error)) std::signal(SIGPIPE, SIG_DFL), std::raise(SIGPIPE);
    complain(describe_error(error));
    return exit_code_of(error);
  }
} catch (const std::exception& error) {  // thrown outside the inner try block
  complain(describe_error(error));
  return exit_code_of(error);
}

}  // namespace laboratory
