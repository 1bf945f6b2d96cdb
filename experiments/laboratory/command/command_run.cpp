#include <fmt/format.h>

#include <cmath>
#include <thread>

#include "base/text.hpp"
#include "experiments/laboratory/command/commands.hpp"
#include "experiments/laboratory/command/run.hpp"
#include "experiments/laboratory/guide/catalogue.hpp"
#include "experiments/laboratory/host/streams.hpp"
#include "experiments/laboratory/options/options.hpp"

namespace laboratory {
namespace {

// Declares an option that takes a simulated time in seconds, from the start of the program.
base::Field<RunOptions> seconds_field(const std::string& name, double RunOptions::*member,
                                      const std::string& help) {
  auto field =
      base::Declare<RunOptions>::number(name, member, 0, std::numeric_limits<double>::max(), "",
                                        "simulated seconds from the start of the program " + help);
  field.domain.expected = "a number of seconds from 0";
  return field;
}

// The default file name of a film. The file lies beside the results folder.
std::string choose_film(const std::string& kind, const RunOptions& options) {
  auto results = results_folder(options).lexically_normal();
  if (!results.has_filename()) results = results.parent_path();
  return results.string() + "-" + kind + ".webp";
}

// Reads the value of --animate: the kind of film, and perhaps a file, as in "picture=grown.webp".
void read_film(const std::string& text, RunOptions& options) {
  const auto kind = text.substr(0, text.find('='));
  auto* file = kind == "picture"   ? &options.films.picture
               : kind == "network" ? &options.films.network
                                   : nullptr;
  require_option(file && !text.ends_with('='), "--animate",
                 "found {}, expected picture, network, picture=FILE or network=FILE", text);
  require_option(file->empty(), "--animate", "found {} twice, expected it at most once", kind);
  *file = kind == text ? choose_film(kind, options) : text.substr(kind.size() + 1);
}

void read_films(const std::vector<std::string>& texts, RunOptions& options) {
  for (const auto& text : texts) read_film(text, options);
  const auto &picture = options.films.picture, &network = options.films.network;
  check_apart("--animate", picture, {network, options.trace, options.timeline});
  check_apart("--animate", network, {options.trace, options.timeline});
}

// More threads than processors only slow the run.
void note_threads(unsigned threads) {
  const unsigned processors = std::max(1u, std::thread::hardware_concurrency());
  if (threads > processors)
    complain(fmt::format("--threads: found {}, but this computer runs {} at a time", threads,
                         processors));
}

// Adds the options that choose points, machines and columns.
void add_choice_options(CLI::App& command, const std::shared_ptr<RunOptions>& o) {
  auto* list = command.add_flag(
      "--list", o->list, "only list the points: number, key, axes, and whether a record exists");
  command
      .add_option("--point", o->points,
                  "K or A-B, repeatable: run only these points and record them in the folder, for "
                  "tlab merge")
      ->allow_extra_args(false)
      ->excludes(list);
  auto* machines = add_key_option(
      command, "uncertain", "uncertain.machines", o->overrides,
      "also run so many machines drawn from the ranges of the model's entries, and report "
      "confidence intervals");
  add_key_option(command, "seed", "uncertain.seed", o->overrides, "seed for the drawn machines")
      ->needs(machines);
  add_names_option(
      command, "--columns",
      [o](const auto& names) {
        o->overrides.push_back({"report.columns", make_node(names)});
      },
      COLUMNS_HELP);
}

// Adds the options for recording the single point of an experiment. Returns the values of
// --animate, once they are parsed.
std::shared_ptr<const std::vector<std::string>> add_recording_options(CLI::App& command,
                                                                      RunOptions& o) {
  command
      .add_option("--trace", o.trace,
                  "file for a trace of all processors and links of the single point: .json for "
                  "Perfetto and chrome://tracing, .paje for ViTE")
      ->check(check_file_name);
  command.add_option("--timeline", o.timeline, "file for the same trace as a chart (.svg or .pdf)")
      ->check(check_file_name);
  const auto films = std::make_shared<std::vector<std::string>>();
  auto* animate =
      command
          .add_option(
              "--animate", *films,
              "picture or network, repeatable: a film of the single point, of its growing picture "
              "or of the load of processors and links; .webp, or .png for one image per frame, "
              "NAME-0001.png ... [RESULTS-KIND.webp beside the results folder]")
          ->allow_extra_args(false)
          ->option_text("KIND[=FILE]");
  bind_options<RunOptions>(
      command,
      {base::Declare<RunOptions>::whole(
          "frames", [](auto& options) -> auto& { return options.films.frames; }, MIN_FRAMES,
          MAX_FRAMES, "", "number of frames of a film")},
      o);
  command.get_option("--frames")->needs(animate);
  command.add_flag("--yes", o.films.is_confirmed, "draw films even if that takes minutes")
      ->needs(animate);
  return films;
}

}  // namespace

void add_run_command(CLI::App& app) {
  auto* command = app.add_subcommand("run", "run an experiment: one run or a sweep");
  auto o = std::make_shared<RunOptions>();
  command
      ->add_option("EXPERIMENT", o->file,
                   "the experiment file (TOML), or a name that tlab list shows, such as farm")
      ->required();
  add_run_options(*command, *o, "results folder [results/EXPERIMENT's name]",
                  "key.path=value: replaces a key of the experiment");
  add_choice_options(*command, o);
  using D = base::Declare<RunOptions>;
  bind_options<RunOptions>(
      *command,
      {D::whole("threads", &RunOptions::threads, 1, 1024, "",
                "threads for the machine of one point, for large machines with run.engine = "
                "\"direct\"; results do not change"),
       seconds_field("until", &RunOptions::until_s, "after which a point is ended early"),
       seconds_field("from", &RunOptions::from_s, "after which trace, time line and films begin")},
      *o);
  command->add_flag("--profile", o->profile,
                    "print the host time per simulated ray in addition to the kernel's");
  const auto films = add_recording_options(*command, *o);
  command->footer(
      "Examples:\n  tlab run experiments/farm.toml --jobs 2\n  tlab run e.toml --set "
      "network.topology=mesh --set 'sweep.workers=[4,9,16]' -o results/mesh\n  tlab run e.toml "
      "--uncertain 64      # with confidence intervals\n  tlab help farm                     # "
      "keys of a program; tlab help keys: of all programs");
  command->callback([o, films, command, jobs = command->get_option("--jobs")] {
    o->file = find_listed(o->file);
    note_threads(o->threads);
    if (jobs->count() == 0) o->jobs = std::max(1u, o->jobs / o->threads);
    if (o->list) return list_points(*o);
    read_films(*films, *o);
    require_option(command->count("--from") == 0 || o->wants_trace() || o->films.is_asked(),
                   "--from", "expected --trace, --timeline or --animate with this option");
    if (!o->points.empty()) return run_chosen_points(*o);
    run_experiment(*o);
  });
}

}  // namespace laboratory
