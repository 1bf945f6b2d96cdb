#include "simulator/observe/use.hpp"

#include <unordered_map>

#include "simulator/observe/mean.hpp"

namespace observe {

namespace {

void check_busy(const std::string& who, double busy_s, double time_s) {
  if (busy_s > time_s * (1 + 1e-9) + 1e-9)
    throw base::InvariantBroken(
        fmt::format("{} was busy for {} s of {} s simulated", who, busy_s, time_s));
}

ProcessRow make_row(const machine::Process& process) {
  using Kind = machine::Wait::Kind;
  return {process.id(), process.name(), process.blocked(Kind::output).value,
          process.blocked(Kind::input).value, process.blocked(Kind::alternative).value};
}

// Subtracts the rows of `before` from `rows`. Rows are matched by process id, because processes may
// have ended or started in between.
void subtract(std::vector<ProcessRow>& rows, const std::vector<ProcessRow>& before) {
  std::unordered_map<machine::ProcessId, const ProcessRow*> known;
  for (const auto& row : before) known[row.id] = &row;
  for (auto& row : rows) {
    const auto found = known.find(row.id);
    if (found == known.end()) continue;
    row.output_s -= found->second->output_s;
    row.input_s -= found->second->input_s;
    row.alternative_s -= found->second->alternative_s;
  }
}

}  // namespace

Use collect(const machine::Machine& machine) {
  Use use{.time_s = machine.now().value, .cpus = {}, .links = {}, .processes = {}};
  for (const auto& processor : machine.processors()) {
    const auto cpu = processor->use();
    use.cpus.push_back({processor->name(),
                        processor->role(),
                        cpu.busy().value,
                        cpu.busy_high.value,
                        cpu.preemptions,
                        cpu.dispatches,
                        processor->memory().peak(),
                        processor->model().base,
                        {}});
    check_busy(processor->name(), cpu.busy().value, use.time_s);
    for (const auto& process : processor->processes()) use.processes.push_back(make_row(*process));
  }
  for (const auto& link : machine.links()) {
    const auto u = link->use();
    use.links.push_back({link->from().name(), link->to().name(), link->beside(), u.busy.value,
                         u.messages, u.bytes});
    check_busy(link->name(), u.busy.value, use.time_s);
  }
  return use;
}

Use between(const Use& before, const Use& after) {
  Use use = after;
  use.time_s -= before.time_s;
  for (std::size_t i = 0; i < use.cpus.size(); ++i) {
    use.cpus[i].busy_s -= before.cpus[i].busy_s;
    use.cpus[i].busy_high_s -= before.cpus[i].busy_high_s;
    use.cpus[i].preemptions -= before.cpus[i].preemptions;
    use.cpus[i].dispatches -= before.cpus[i].dispatches;
  }
  for (std::size_t i = 0; i < use.links.size(); ++i) {
    use.links[i].busy_s -= before.links[i].busy_s;
    use.links[i].messages -= before.links[i].messages;
    use.links[i].bytes -= before.links[i].bytes;
  }
  subtract(use.processes, before.processes);
  return use;
}

std::string name_of(const LinkRow& link) {
  const auto name = link.from + ">" + link.to;
  return link.beside == 0 ? name : fmt::format("{} ({})", name, link.beside + 1);
}

const ProcessRow& find_process(const Use& use, machine::ProcessId id) {
  const auto found = std::ranges::find(use.processes, id, &ProcessRow::id);
  if (found == use.processes.end())
    throw base::InvariantBroken(fmt::format("no process has the id {}", id));
  return *found;
}

std::uint64_t total_messages(const Use& use) {
  std::uint64_t sum = 0;
  for (const auto& link : use.links) sum += link.messages;
  return sum;
}

std::uint64_t total_bytes(const Use& use) {
  std::uint64_t sum = 0;
  for (const auto& link : use.links) sum += link.bytes;
  return sum;
}

base::Columns<Use> message_columns() {
  return {base::column<Use>("messages_sent", &total_messages,
                            "messages over links; each counts on every link it passes"),
          base::column<Use>("bytes_sent", &total_bytes, "bytes of these messages")};
}

base::Column<Use> link_busy_column() {
  return base::column<Use>(
      "link_busy_max",
      [](const Use& use) {
        double busy_s = 0;
        for (const auto& link : use.links) busy_s = std::max(busy_s, link.busy_s);
        return observe::eval_mean(busy_s, use.time_s);
      },
      "share of the time that the busiest direction of a link was busy");
}

}  // namespace observe
