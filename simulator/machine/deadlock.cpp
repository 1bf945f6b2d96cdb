#include "simulator/machine/deadlock.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "simulator/machine/faults.hpp"

namespace machine {

namespace {

// The processes that have not ended, on processors that run.
using Blocked = std::map<ProcessId, const Process*>;
// The processes that each of them waits for.
using Waits = std::map<ProcessId, std::vector<ProcessId>>;

bool waits_for_input(const Process& process) {
  if (process.state() != Process::State::blocked || !process.wait()) return false;
  const auto kind = process.wait()->kind();
  return kind == Wait::Kind::input || kind == Wait::Kind::alternative;
}

bool has_ended(const Process& process) {
  return process.state() == Process::State::ended ||
         (process.is_server() && waits_for_input(process));
}

Blocked find_blocked(const Machine& machine) {
  Blocked blocked;
  for (const auto& processor : machine.processors())
    for (const auto& process : processor->processes())
      if (!processor->stopped() && !has_ended(*process)) blocked[process->id()] = process.get();
  return blocked;
}

// Follows the waits from `process`; `path` ends with the first process that comes again.
bool find_cycle(ProcessId process, const Waits& waits, std::set<ProcessId>& seen,
                std::vector<ProcessId>& path) {
  const auto on_path = std::ranges::find(path, process);
  if (on_path != path.end()) {
    path.erase(path.begin(), on_path);
    path.push_back(process);
    return true;
  }
  if (!seen.insert(process).second) return false;
  path.push_back(process);
  for (ProcessId next : waits.at(process))
    if (waits.contains(next) && find_cycle(next, waits, seen, path)) return true;
  path.pop_back();
  return false;
}

std::string describe_wait(const Process& process, const std::vector<ProcessId>& partners,
                          const Blocked& blocked) {
  std::string text =
      fmt::format("\n  {} on {} waits for {}", process.name(), process.processor().name(),
                  process.wait() ? process.wait()->describe() : "its start");
  std::string names;
  for (ProcessId partner : partners)
    names +=
        fmt::format("{}{}", names.empty() ? "" : ", ",
                    blocked.contains(partner) ? blocked.at(partner)->name() : "one that has ended");
  return names.empty() ? text : fmt::format("{} (from {})", text, names);
}

std::string describe_cycle(const Waits& waits, const Blocked& blocked) {
  std::set<ProcessId> seen;
  for (const auto& [process, ignored] : waits) {
    std::vector<ProcessId> path;
    if (!find_cycle(process, waits, seen, path)) continue;
    std::string text;
    for (ProcessId p : path) text += (text.empty() ? " " : " -> ") + blocked.at(p)->name();
    return "\n  the cycle:" + text;
  }
  return "";
}

}  // namespace

bool has_unfinished(const Processor& processor) {
  return !std::ranges::all_of(processor.processes(), [](const auto& p) { return has_ended(*p); });
}

bool all_have_ended(const Machine& machine) {
  return std::ranges::all_of(machine.processors(),
                             [](const auto& p) { return p->stopped() || !has_unfinished(*p); });
}

void throw_if_deadlocked(const Machine& machine) {
  const Blocked blocked = find_blocked(machine);
  if (blocked.empty()) return;
  Waits waits;
  for (const auto& [id, process] : blocked)
    waits[id] = process->wait() ? process->wait()->waits_for() : std::vector<ProcessId>{};
  std::string text =
      fmt::format("deadlock at {:.6f} s, nothing can happen any more:", machine.now().value);
  for (const auto& processor : machine.processors())
    for (const auto& process : processor->processes())
      if (blocked.contains(process->id()))
        text += describe_wait(*process, waits.at(process->id()), blocked);
  throw Deadlock("machine", machine.now(), text + describe_cycle(waits, blocked));
}

}  // namespace machine
