#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/command/commands.hpp"
#include "experiments/laboratory/command/run.hpp"
#include "experiments/laboratory/host/interrupt.hpp"
#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/host/results_folder.hpp"
#include "experiments/laboratory/host/streams.hpp"
#include "experiments/laboratory/host/temporary_folder.hpp"
#include "experiments/laboratory/live/recording.hpp"
#include "experiments/laboratory/live/server.hpp"
#include "experiments/laboratory/options/options.hpp"
#include "experiments/laboratory/points/point_store.hpp"
#include "experiments/laboratory/points/points.hpp"
#include "experiments/laboratory/points/run_point.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

struct LiveOptions {
  std::string source;  ///< an experiment file, or a folder of earlier results
  std::string output, record, speed = "1";
  Overrides overrides;
  std::optional<std::uint16_t> port;
  bool no_browser = false;
};

// Reads the value of --speed, in simulated seconds per second of real time.
double read_speed(const std::string& text) {
  if (text == "max") return std::numeric_limits<double>::infinity();
  const auto speed = base::parse_number<double>(text);
  base::require(
      speed && *speed >= 1e-9 && *speed <= 1e9, "--speed",
      "found {}, expected max, or a number of simulated seconds per second from 1e-9 to 1e9", text);
  return *speed;
}

// Loads the experiment for the engine "direct", the only one whose clock can be slowed down.
ExperimentFile load(const LiveOptions& o) {
  auto overrides = o.overrides;
  overrides.push_back({"run.engine", make_node("direct")});
  if (!fs::is_directory(o.source)) return load_experiment(o.source, overrides);
  return load_origin(o.source, "run.json", overrides).file;
}

void check_live(const LiveOptions& o, const ExperimentFile& file) {
  base::require(file.points.size() == 1, o.source,
                "the experiment has {} points, expected one; choose it with --set, for example "
                "--set 'sweep.workers=[4]'",
                file.points.size());
  base::require(
      !file.points[0].experiment.is_timed, o.source,
      "found cost = \"timed\", expected \"counted\": the page would change the host times");
}

fs::path find_recording(const LiveOptions& o, const ExperimentFile& file) {
  if (!o.record.empty()) {
    base::require(fs::path(o.record).extension() == ".toml", "--record",
                  "found {}, expected a name that ends in .toml", o.record);
    std::error_code error;
    base::require(!fs::equivalent(o.record, o.source, error), "--record",
                  "found the experiment itself, {}, expected another file", o.record);
    return o.record;
  }
  // Chooses a new file name, so that recordings of earlier sessions are not overwritten.
  const auto name = fs::path(file.path).stem().string() + "-live";
  fs::path recording = fs::path("results") / (name + ".toml");
  for (int number = 2; fs::exists(recording); ++number)
    recording.replace_filename(fmt::format("{}{}.toml", name, number));
  return recording;
}

// A temporary page that redirects the browser to the session's secret address. Passing the address
// itself on the browser's command line would show it to all users of the computer, but only the
// owner can read this page. The destructor removes the page.
class Doorway {
 public:
  /// Throws std::system_error if the temporary folder cannot be made.
  explicit Doorway(const std::string& address) {
    std::ofstream(file()) << fmt::format("<meta http-equiv=\"refresh\" content=\"0;url={}\">\n",
                                         address);
  }

  std::string file() const { return (folder_.path() / "live.html").string(); }

 private:
  TemporaryFolder folder_;
};

// Opens the file in a browser. Ignores errors, since the user can also open the printed address.
void open_browser(const std::string& file) {
  std::string program = "xdg-open", argument = file;
  char* arguments[] = {program.data(), argument.data(), nullptr};
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  for (const int stream : {1, 2})
    posix_spawn_file_actions_addopen(&quiet, stream, "/dev/null", 1 /* to write */, 0);
  pid_t browser = -1;
  posix_spawnp(&browser, program.c_str(), &quiet, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&quiet);
}

// Stores the session's result as if `tlab run` had simulated the session's recording, so that `tlab
// run` of the recording need not simulate it again. Returns the options for that `tlab run`.
RunOptions keep_result(const RunOptions& options, const Session& session, PointResult result) {
  RunOptions rerun = options;
  if (const auto ended_s = session.ended_by_hand_s()) {
    rerun.until_s = *ended_s;
    result.ended = machine::to_string(machine::End::limit);
  }
  const auto recording = load_experiment(options.file, {});
  const PointsPlan plan(rerun, recording);
  save_origin(plan.results, recording, plan.origin);
  // Failed points are not stored: `tlab run` simulates them again.
  if (!result.is_failed())
    save_record(plan.results / records_folder(), plan.keys.at(0), result, "");
  return rerun;
}

// Simulates the experiment's only point, controlled by the browser pages of the session. Writes a
// recording of the user's actions to options.file, even if the simulation fails.
RunOptions run_watched(const RunOptions& options, const ExperimentFile& file, Session& session) {
  std::optional<PointResult> result;
  std::exception_ptr failure;
  try {
    result = run_point(file.points[0], options, results_folder(options) / records_folder(),
                       {.controller = &session});
  } catch (const machine::Fault&) {
    // the caller simulates the recording again, which reports the fault
  } catch (...) {
    failure = std::current_exception();
  }
  const auto folder = fs::path(options.file).parent_path().string();
  base::save_whole(options.file, record_session(file, session.actions(), folder));
  if (failure) std::rethrow_exception(failure);
  return result ? keep_result(options, session, std::move(*result)) : options;
}

RunOptions make_run_options(const LiveOptions& o, const ExperimentFile& file) {
  RunOptions options;
  options.file = find_recording(o, file).string();
  options.output = o.output;
  check_results_folder(results_folder(options));
  check_points(options, file);
  if (const auto parent = fs::path(options.file).parent_path(); !parent.empty())
    fs::create_directories(parent);
  base::check_can_save(options.file);
  return options;
}

void watch_run(const LiveOptions& o) {
  const double speed = read_speed(o.speed);
  const auto file = load(o);
  check_live(o, file);
  auto options = make_run_options(o, file);

  const InterruptGuard guard;
  Session session(file, speed);
  const Server server(session, o.port);
  print_out("{}\n", server.address());
  flush_output();
  std::optional<Doorway> doorway;
  if (!o.no_browser) open_browser(doorway.emplace(server.address()).file());

  const auto folder = results_folder(options);
  const StoreGuard store(folder);
  options = run_watched(options, file, session);
  const bool was_cut = was_interrupted();
  std::exception_ptr failure;
  try {
    run_experiment(options);
  } catch (const std::exception&) {
    failure = std::current_exception();
  }
  const auto rerun = command_line(options);
  session.say_results(fmt::format("{}; to repeat it: {}", folder.string(), rerun));
  print_out("\nThe session: {}\n", rerun);
  flush_output();
  if (!was_cut) session.wait_for_quit();
  if (was_cut)
    throw Failure(fmt::format("interrupted; the session so far is in {}", folder.string()),
                  EXIT_INTERRUPTED);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace

void add_live_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "live", "watch a run on a page in the browser and control it: pause, step, orders, faults");
  auto o = std::make_shared<LiveOptions>();
  command
      ->add_option(
          "EXPERIMENT", o->source,
          "experiment file (TOML) with one point, or a results folder whose point is repeated")
      ->required();
  add_set_option(*command, o->overrides, "key.path=value: replaces a key of the experiment");
  command
      ->add_option("--speed", o->speed,
                   "simulated seconds per second of real time; max: as fast as possible")
      ->capture_default_str();
  command
      ->add_option("--port", o->port, "TCP port of the page on this computer [8080, or a free one]")
      ->check(check_value({base::Domain::Kind::whole, 1, 65535}))
      ->option_text("1..65535");
  command->add_flag("--no-browser", o->no_browser,
                    "print the page's address without opening a browser");
  command
      ->add_option("--record", o->record,
                   "experiment file that records the session [results/EXPERIMENT's "
                   "name-live.toml, or -live2 ...]")
      ->check(check_file_name);
  command->add_option("-o,--output", o->output, "results folder [results/the recording's name]")
      ->check(check_folder_name);
  command->footer("Examples:\n  tlab live experiments/live.toml");
  command->callback([o] { watch_run(*o); });
}

}  // namespace laboratory
