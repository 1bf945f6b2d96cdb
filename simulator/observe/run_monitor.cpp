#include "simulator/observe/run_monitor.hpp"

#include <algorithm>

namespace observe {

namespace {

using machine::LinkDirection;
using machine::Processor;
using machine::Seconds;

// Observer of the machine that fills a trace during the run.
class TraceRecorder : public machine::Observer {
 public:
  TraceRecorder(const machine::Machine& machine, Trace& trace, Seconds from) : trace_(trace) {
    trace_.begin_s = from.value;
    for (const auto& processor : machine.processors())
      trace_.processors.push_back(processor->name());
    processes_.resize(trace_.processors.size());
    for (const auto& link : machine.links()) {
      links_[link.get()] = static_cast<std::uint32_t>(trace_.links.size());
      trace_.links.push_back({number(link->from()), number(link->to())});
    }
  }

  void name_process(const Processor& on, std::uint32_t id, const std::string& name) override {
    auto& known = processes_.at(number(on));
    known.resize(std::max<std::size_t>(known.size(), id + 1));
    known[id] = static_cast<std::uint32_t>(trace_.processes.size());
    trace_.processes.push_back({name, number(on)});
  }

  void ran(const Processor& on, std::uint32_t id, Doing doing, Seconds from, Seconds to) override {
    if (to.value <= trace_.begin_s) return;
    trace_.spans.push_back({from.value, to.value, number(on), processes_[number(on)][id], doing});
  }

  void moved(const LinkDirection& link, const std::string& channel, std::uint64_t bytes,
             Seconds from, Seconds to) override {
    if (to.value <= trace_.begin_s) return;
    const auto next = static_cast<std::uint32_t>(trace_.channels.size());
    const auto [place, added] = channels_.emplace(&channel, next);
    if (!added && trace_.channels[place->second] != channel) place->second = next;
    if (place->second == next) trace_.channels.push_back(channel);
    trace_.transfers.push_back({from.value, to.value, links_.at(&link), place->second, bytes});
  }

  // Removes spans that begin after the end of the run. Their cycles were charged in advance but
  // were not executed.
  void close(Seconds end) {
    trace_.end_s = std::max(end.value, trace_.begin_s);
    std::erase_if(trace_.spans, [&](const auto& s) { return s.from_s >= trace_.end_s; });
    for (auto& span : trace_.spans) clip(span);
    for (auto& transfer : trace_.transfers) clip(transfer);
  }

 private:
  void clip(auto& part) const {
    part.from_s = std::max(part.from_s, trace_.begin_s);
    part.to_s = std::min(part.to_s, trace_.end_s);
  }
  static std::uint32_t number(const Processor& p) { return static_cast<std::uint32_t>(p.id()); }

  Trace& trace_;
  // Index into Trace::processes, by processor and by id on that processor.
  std::vector<std::vector<std::uint32_t>> processes_;
  std::map<const LinkDirection*, std::uint32_t> links_;
  // Index into Trace::channels, by address of the channel's name.
  std::map<const std::string*, std::uint32_t> channels_;
};

// True if any link has been cut or any processor has stopped.
bool is_broken(const machine::Machine& machine) {
  return std::ranges::any_of(machine.links(), [](const auto& link) { return link->is_cut(); }) ||
         std::ranges::any_of(machine.processors(), &machine::Processor::stopped);
}

}  // namespace

machine::End run(machine::Machine& machine, RunMonitor& monitor, const ControlPanel& view) {
  std::optional<TraceRecorder> recorder;
  if (monitor.trace) machine.set_observer(&recorder.emplace(machine, *monitor.trace, monitor.from));
  if (monitor.controller) {
    machine.set_pace(*monitor.controller);
    monitor.controller->begin(machine, view);
  }
  if (monitor.observer) monitor.observer->begin(machine, view);
  auto close = [&](const std::string& fault) {
    if (monitor.observer) monitor.observer->end(machine.now().value);
    if (monitor.controller) monitor.controller->end(fault);
    monitor.ended = machine.now();
    monitor.events = machine.events();
    if (recorder) recorder->close(machine.now());
  };
  try {
    monitor.end = machine.run(monitor.until);
  } catch (const machine::Deadlock& deadlock) {
    close(deadlock.what());
    if (!is_broken(machine)) throw;
    monitor.end = machine::End::deadlock;
    monitor.deadlock = std::current_exception();
    return monitor.end;
  } catch (const std::exception& fault) {
    close(fault.what());
    throw;
  }
  close("");
  return monitor.end;
}

machine::End run(machine::Machine& machine, RunMonitor* monitor, const ControlPanel& view) {
  RunMonitor none, &used = monitor ? *monitor : none;
  const auto end = run(machine, used, view);
  if (!monitor && end == machine::End::deadlock) std::rethrow_exception(used.deadlock);
  return end;
}

}  // namespace observe
