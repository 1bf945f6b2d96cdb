#include "experiments/laboratory/points/run_point.hpp"

#include <fmt/ranges.h>

#include <ctime>
#include <set>

#include "base/errors.hpp"
#include "experiments/laboratory/file/schema.hpp"
#include "experiments/laboratory/points/images.hpp"
#include "experiments/laboratory/setup/setup.hpp"
#include "topologies/graph/partition.hpp"
#include "topologies/make/generators.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;
using base::require;
using nlohmann::ordered_json;
using programs::Setup;

// CPU time of this process in seconds; other programs on the host do not affect it.
double process_cpu_s() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Makes what a program needs for its simulation: model, engine and costs, but not yet its network.
Setup make_setup(const Experiment& experiment, const machine::Model& model) {
  Setup setup{.model = model, .topology = topologies::make_line(1), .engine = experiment.engine};
  setup.cycles_per_host_s = experiment.cycles_per_host_s;
  if (experiment.is_timed && !setup.cycles_per_host_s) setup.cycles_per_host_s = 1;
  return setup;
}

void add_network(Setup& setup, const Experiment& experiment, unsigned threads) {
  const auto& uses = experiment.program->uses;
  if (uses.network) setup.topology = make_workers(experiment);
  if (threads > 1)
    setup.engine.parts = topologies::make_partition(setup.topology, static_cast<int>(threads));
  if (uses.routes) {
    setup.routes = find_routes(experiment, setup.topology);
    setup.tree = find_tree(experiment, setup.topology);
  }
  setup.faults = find_faults(experiment, setup.topology);
  if (uses.others) setup.others = find_others(experiment, setup.topology, setup.model);
}

// Describes a point before its simulation. The caller passes the network, since making it may take
// seconds.
PointResult describe(const Experiment& experiment, const topologies::Topology& topology) {
  const auto& program = *experiment.program;
  PointResult result;
  if (program.uses.network) {
    result.topology = topology.name;
    result.processors = topology.processors - program.services;
  }
  if (program.describe) result.described = program.describe(experiment.params);
  return result;
}

// Throws unless there is exactly one row of results. Programs that declare the columns `parts` may
// have several rows, each with a different combination of values in these columns.
void check_rows(const programs::Program& program, const std::vector<base::Row>& rows) {
  if (program.parts.empty()) return base::check_equal("rows of a point", rows.size(), 1u);
  std::set<std::vector<base::Cell>> known;
  for (const auto& row : rows) {
    std::vector<base::Cell> key;
    for (const auto& part : program.parts)
      for (const auto& [name, cell] : row)
        if (name == part && cell != base::Cell()) key.push_back(cell);
    if (key.size() != program.parts.size() || !known.insert(key).second)
      throw base::InvariantBroken(
          fmt::format("the program {} has two rows with the same {}, or "
                      "one without",
                      program.name, fmt::join(program.parts, ", ")));
  }
  if (rows.empty())
    throw base::InvariantBroken(fmt::format("the program {} has no row", program.name));
}

ordered_json make_use(const programs::Outcome<base::Row>& outcome) {
  if (!outcome.use) return {};
  const auto& use = *outcome.use;
  // Uses arrays for large machines: before each insertion, an ordered JSON object searches all its
  // members.
  auto cpus = ordered_json::array(), links = cpus, loads = cpus;
  for (const auto& cpu : use.cpus) {
    cpus.push_back({{"name", cpu.name},
                    {"model", cpu.model},
                    {"busy", cpu.busy_s / use.time_s},
                    {"busy_high", cpu.busy_high_s / use.time_s},
                    {"preemptions", cpu.preemptions},
                    {"memory_peak_bytes", cpu.memory_peak_bytes}});
    if (cpu.tasks) cpus.back()["tasks"] = *cpu.tasks;
  }
  for (const auto& link : use.links) {
    links.push_back({{"from", link.from},
                     {"to", link.to},
                     {"busy", link.busy_s / use.time_s},
                     {"messages", link.messages},
                     {"bytes", link.bytes}});
    if (link.beside > 0) links.back()["number"] = link.beside + 1;
  }
  for (const auto& load : outcome.loads)
    loads.push_back({{"resource", load.resource}, {"busy", load.busy}, {"doing", load.doing}});
  return {{"loads", loads}, {"cpus", cpus}, {"links", links}};
}

ordered_json make_kernels(const std::vector<observe::KernelUse>& uses) {
  ordered_json kernels;
  for (const auto& use : uses)
    kernels[use.name] = {{"calls", use.calls},
                         {"host_s", use.host_s},
                         {"cycles_counted", use.counted.value},
                         {"cycles_charged", use.charged.value},
                         {"longest_batch_s", use.longest_batch_s},
                         {"too_short", use.is_short}};
  return kernels;
}

void tell_failure(PointResult& result, const std::exception_ptr& why) {
  try {
    std::rethrow_exception(why);
  } catch (const std::exception& error) {
    const auto failure = make_failure(error);
    result.message = failure.value().message;
    result.exit_code = failure->exit_code;
    result.fault_s = failure->fault_s;
  }
}

PointResult run(const Experiment& experiment, const fs::path& images, const RunOptions& options,
                observe::RunMonitor& monitor) {
  const double start_s = process_cpu_s();
  const auto model = make_model(experiment.model);
  auto setup = make_setup(experiment, model);
  setup.monitor = &monitor;
  setup.profile = options.profile;
  add_network(setup, experiment, options.threads);
  auto result = describe(experiment, setup.topology);
  const double run_start_s = process_cpu_s();
  try {
    auto outcome = experiment.program->run(setup, experiment.params);
    result.host.run_s = process_cpu_s() - run_start_s;
    check_rows(*experiment.program, outcome.rows);
    const bool is_done = outcome.end == machine::End::done;
    result.ended = is_done && outcome.is_saturated ? "saturated" : machine::to_string(outcome.end);
    result.images = save_images(outcome.images, images);
    result.growth = std::move(outcome.growth);
    result.histogram = std::move(outcome.histogram);
    result.use = make_use(outcome);
    result.kernels = make_kernels(outcome.kernels);
    result.host.kernel_s = outcome.kernel_host_s;
    result.host.events = outcome.events;
    result.rows = std::move(outcome.rows);
    result.notes = std::move(outcome.notes);
    if (monitor.deadlock) tell_failure(result, monitor.deadlock);
  } catch (const programs::Unfinished&) {
    result.ended = machine::to_string(monitor.end);
  }
  result.host.total_s = process_cpu_s() - start_s;
  return result;
}

}  // namespace

void check_point(const Experiment& experiment) {
  check_files(experiment);
  const auto model = make_model(experiment.model);
  if (!experiment.others.empty()) {
    const auto& place = experiment.others[0].place;
    require(experiment.program->uses.others, place,
            "the program {} does not support processors of other models", experiment.program->name);
    require(
        !experiment.is_timed, place,
        "found run.cost = \"timed\", expected counted: host times are scaled to one model only");
    find_others(experiment, make_workers(experiment), model);
  }
  if (!experiment.program->check) return;
  auto setup = make_setup(experiment, model);
  // making the network is slow, so it is made only for programs that check it
  if (experiment.program->services > 0 || !experiment.faults.empty())
    setup.topology = make_workers(experiment);
  if (!experiment.faults.empty()) setup.faults = find_faults(experiment, setup.topology);
  experiment.program->check(setup, experiment.params);
}

void check_threads(const RunOptions& options, const Experiment& experiment) {
  if (options.threads == 1) return;
  const auto refuse_if = [&](bool is_so, const char* found, const char* expected) {
    require(!is_so, "--threads", "found {} with {}, expected {}", options.threads, found, expected);
  };
  require(experiment.program->uses.threads, "--threads",
          "found {} with the program {}, which supports only one, expected one of {}",
          options.threads, experiment.program->name, list_users(&programs::Uses::threads));
  refuse_if(experiment.engine.links != machine::Links::direct, "run.engine = \"simgrid\"",
            "run.engine = \"direct\", because SimGrid uses one thread");
  refuse_if(!experiment.faults.empty(), "[[fault]]", "one");
  refuse_if(make_model(experiment.model).channel.least_to_link().value <= 0,
            "channel.operands + channel.blocked of 0 cycles", "one");
  refuse_if(options.wants_trace(), "a trace, a time line or a film", "one");
}

PointResult describe_point(const Experiment& experiment) {
  const bool has_network = experiment.program->uses.network;
  return describe(experiment, has_network ? make_workers(experiment) : topologies::make_line(1));
}

PointResult run_point(const Point& point, const RunOptions& options, const fs::path& images,
                      observe::RunMonitor monitor) {
  monitor.until = {options.until_s};
  monitor.from = {options.from_s};
  return run(point.experiment, images, options, monitor);
}

}  // namespace laboratory
