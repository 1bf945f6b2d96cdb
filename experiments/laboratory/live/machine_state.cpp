#include "experiments/laboratory/live/machine_state.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "experiments/laboratory/live/user_actions.hpp"
#include "experiments/laboratory/places/places.hpp"
#include "experiments/laboratory/setup/setup.hpp"
#include "topologies/make/generators.hpp"

namespace laboratory {

using nlohmann::ordered_json;

namespace {

constexpr std::size_t MOST_PROCESSES = 64;  // limit on the processes described for a processor
constexpr std::size_t MOST_BUSY = 1 << 20;  // limit on the number of stored busy times

int per_mille(double share) {
  return static_cast<int>(std::lround(1e3 * std::clamp(share, 0., 1.)));
}

std::string_view to_string(machine::Process::State state) {
  constexpr std::string_view NAMES[] = {"ready", "running", "blocked", "ended"};
  return NAMES[static_cast<int>(state)];
}

bool is_of_network(const observe::ControlPanel& view, int processor) {
  return view.network.empty() || std::ranges::find(view.network, processor) != view.network.end();
}

std::vector<double> find_shares(const std::vector<double>& after_s,
                                const std::vector<double>& before_s, double time_s) {
  std::vector<double> shares;
  for (std::size_t i = 0; i < after_s.size(); ++i)
    shares.push_back(time_s > 0 ? std::clamp((after_s[i] - before_s[i]) / time_s, 0., 1.) : 0);
  return shares;
}

ordered_json list_per_mille(const std::vector<double>& shares) {
  auto list = ordered_json::array();
  for (const double share : shares) list.push_back(per_mille(share));
  return list;
}

}  // namespace

ordered_json make_outline(const ExperimentFile& file, const machine::Machine& machine,
                          const observe::ControlPanel& view) {
  const auto& experiment = file.points.at(0).experiment;
  const auto& program = *experiment.program;
  const auto topology = program.uses.network ? make_workers(experiment) : topologies::make_line(1);
  const auto places = place_processors(machine, topology, view.network);
  auto processors = ordered_json::array(), links = processors, gauges = processors;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& processor = *machine.processors()[i];
    processors.push_back(
        {{"name", processor.name()},
         {"role", processor.role()},
         {"x", places[i].x},
         {"y", places[i].y},
         {"may_break", program.uses.faults && is_of_network(view, static_cast<int>(i))}});
  }
  for (std::size_t i = 0; i < machine.links().size(); i += 2) {
    const auto& link = *machine.links()[i];
    links.push_back({link.from().id(), link.to().id()});
  }
  for (const auto& gauge : view.gauges)
    gauges.push_back({{"name", gauge.name}, {"help", gauge.help}});
  const bool has_user = view.take_order && program.find_list("order");
  ordered_json outline = {{"title", experiment.title},
                          {"question", experiment.question},
                          {"file", file.path},
                          {"program", program.name},
                          {"help", program.help},
                          {"network", topology.name},
                          {"model", experiment.model.source.text},
                          {"processors", processors},
                          {"links", links},
                          {"gauges", gauges},
                          {"has_sequential", view.sequential != nullptr},
                          {"has_user", has_user}};
  if (view.picture)
    outline["picture"] = {{"width", view.picture->width}, {"height", view.picture->height}};
  if (has_user) outline["limits"] = describe_limits(*program.find_list("stage"));
  return outline;
}

ordered_json describe_processor(const machine::Processor& processor,
                                const observe::ControlPanel& view) {
  auto processes = ordered_json::array(), readings = processes;
  for (const auto& inspect : view.inspections)
    for (const auto& reading : inspect(processor.id()))
      readings.push_back({{"name", reading.name}, {"value", reading.value}});
  for (const auto& process : processor.processes()) {
    if (processes.size() == MOST_PROCESSES) break;
    const bool waits = process->state() == machine::Process::State::blocked && process->wait();
    processes.push_back(
        {{"name", process->name()},
         {"priority", process->priority() == machine::Priority::high ? "high" : "low"},
         {"state", to_string(process->state())},
         {"waits_for", waits ? process->wait()->describe() : ""}});
  }
  return {{"name", processor.name()},
          {"memory_bytes", processor.memory().used()},
          {"memory_size_bytes", processor.memory().size()},
          {"readings", readings},
          {"processes_count", processor.processes().size()},
          {"processes", processes}};
}

ordered_json describe_deadlock(const machine::Machine& machine) {
  auto processors = ordered_json::array(), processes = processors;
  for (const auto* process : machine::find_wait_cycle(machine)) {
    processors.push_back(process->processor().id());
    processes.push_back(process->name());
  }
  return {{"processors", processors}, {"processes", processes}};
}

void RecentLoads::update(const machine::Machine& machine, double now_s) {
  Busy now{now_s, {}, {}};
  for (const auto& processor : machine.processors())
    now.cpus_s.push_back(processor->cpu().use_by({now_s}).busy().value);
  for (const auto& link : machine.links()) now.links_s.push_back(link->use_by({now_s}).busy.value);
  const std::size_t numbers = now.cpus_s.size() + now.links_s.size() + 1;
  const std::size_t most = MOST_BUSY / numbers + 2;
  while (busy_.size() > 1 && (busy_[1].at_s <= now_s - interval_s_ || busy_.size() > most))
    busy_.pop_front();
  if (busy_.empty())
    busy_.push_back(
        {0, std::vector<double>(now.cpus_s.size()), std::vector<double>(now.links_s.size())});
  const Busy& before = busy_.front();
  if (now_s > before.at_s || cpus_.empty()) {
    time_s_ = now_s - before.at_s;
    cpus_ = find_shares(now.cpus_s, before.cpus_s, time_s_);
    links_ = find_shares(now.links_s, before.links_s, time_s_);
  }
  if (now.at_s > busy_.back().at_s) busy_.push_back(std::move(now));
}

double RecentLoads::mean_cpu() const {
  return std::accumulate(cpus_.begin(), cpus_.end(), 0.) / static_cast<double>(cpus_.size());
}

double RecentLoads::max_link() const {
  return links_.empty() ? NAN : *std::ranges::max_element(links_);
}

ordered_json RecentLoads::describe(const machine::Machine& machine, double now_s) const {
  auto queues = ordered_json::array(), moving = queues, cut = queues, stopped = queues;
  for (const auto& processor : machine.processors()) {
    queues.push_back(processor->cpu().ready());
    if (processor->stopped()) stopped.push_back(processor->id());
  }
  for (std::size_t i = 0; i < machine.links().size(); ++i) {
    const auto& link = *machine.links()[i];
    if (link.is_busy()) {
      moving.push_back(i);
      moving.push_back(per_mille(link.passed({now_s})));
    }
    if (link.is_cut()) cut.push_back(i);
  }
  return {{"interval_s", time_s_},
          {"cpus", list_per_mille(cpus_)},
          {"links", list_per_mille(links_)},
          {"queues", queues},
          {"moving", moving},
          {"cut", cut},
          {"stopped", stopped}};
}

}  // namespace laboratory
