#include "simulator/programs/declare/program.hpp"

namespace programs {

namespace {

[[noreturn]] void throw_unfinished(const machine::Machine& machine, machine::End end) {
  throw Unfinished(
      "machine", machine.now(),
      fmt::format("the run ended early at {:.6f} s ({})", machine.now().value, to_string(end)));
}

}  // namespace

const Parameter* Program::find(std::string_view name) const {
  const auto found = std::ranges::find(parameters, name, &Parameter::name);
  return found == parameters.end() ? nullptr : &*found;
}

const RecordList* Program::find_list(std::string_view key) const {
  const auto found = std::ranges::find(lists, key, &RecordList::key);
  return found == lists.end() ? nullptr : &*found;
}

std::string key_of(const Parameter& parameter) {
  const bool has_section = parameter.name.find('.') != std::string::npos;
  return has_section ? parameter.name : "program." + parameter.name;
}

void run_machine(const Setup& setup, machine::Machine& machine, const observe::ControlPanel& view) {
  observe::RunMonitor none, &monitor = setup.monitor ? *setup.monitor : none;
  const machine::End end = observe::run(machine, monitor, view);
  if (end == machine::End::deadlock) std::rethrow_exception(monitor.deadlock);
  if (end != machine::End::done) throw_unfinished(machine, end);
}

void run_machine_until(const Setup& setup, machine::Machine& machine, machine::Seconds date,
                       const observe::ControlPanel& view) {
  observe::RunMonitor none, &monitor = setup.monitor ? *setup.monitor : none;
  const auto asked = monitor.until;
  monitor.until = std::min(asked, date);
  const machine::End end = observe::run(machine, monitor, view);
  monitor.until = asked;
  if (end == machine::End::deadlock) std::rethrow_exception(monitor.deadlock);
  const bool reached = end == machine::End::limit && machine.now() >= date;
  if (end != machine::End::done && !reached) throw_unfinished(machine, end);
  monitor.end = machine::End::done;
}

}  // namespace programs
