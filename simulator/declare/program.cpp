#include "simulator/declare/program.hpp"

namespace programs {

namespace {

[[noreturn]] void throw_unfinished(const machine::Machine& machine, machine::End end) {
  throw Unfinished(
      "machine", machine.now(),
      fmt::format("the run was ended at {:.6f} s ({})", machine.now().value, to_string(end)));
}

}  // namespace

const Parameter* Program::find(std::string_view name) const {
  const auto found = std::ranges::find(parameters, name, &Parameter::name);
  return found == parameters.end() ? nullptr : &*found;
}

std::string key_of(const Parameter& parameter) {
  const bool has_section = parameter.name.find('.') != std::string::npos;
  return has_section ? parameter.name : "program." + parameter.name;
}

void run_machine(const Setup& setup, machine::Machine& machine, const observe::View& view) {
  observe::Watch none, &watch = setup.watch ? *setup.watch : none;
  const machine::End end = observe::run(machine, watch, view);
  if (end == machine::End::deadlock) std::rethrow_exception(watch.deadlock);
  if (end != machine::End::done) throw_unfinished(machine, end);
}

void run_machine_until(const Setup& setup, machine::Machine& machine, machine::Seconds date,
                       const observe::View& view) {
  observe::Watch none, &watch = setup.watch ? *setup.watch : none;
  const auto asked = watch.until;
  watch.until = std::min(asked, date);
  const machine::End end = observe::run(machine, watch, view);
  watch.until = asked;
  if (end == machine::End::deadlock) std::rethrow_exception(watch.deadlock);
  const bool reached = end == machine::End::limit && machine.now() >= date;
  if (end != machine::End::done && !reached) throw_unfinished(machine, end);
  watch.end = machine::End::done;
}

}  // namespace programs
