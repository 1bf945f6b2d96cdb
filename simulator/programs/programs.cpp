// The list of patterns, and how they read their parameters.
#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "simulator/declare/program.hpp"
#include "simulator/machine/faults.hpp"

namespace programs {

// Each in the file of its name.
Pattern make_message();
Pattern make_soft();
Pattern make_both_ways();
Pattern make_unicast();
Pattern make_pipeline();
Pattern make_sources();
Pattern make_broadcast();
Pattern make_request();
Pattern make_alternative();
Pattern make_interrupt();
Pattern make_traffic();
Pattern make_task_farm();
Pattern make_law();
Pattern make_commstime();
Pattern make_flops();
Pattern make_metrics();
Pattern make_census();
Pattern make_deadlock();
Pattern make_global_messages();
Pattern make_random_traffic();
Pattern make_router_load();
Pattern make_soak();
Pattern make_in_path();
Pattern make_data();
Pattern make_radiosity();
Pattern make_scan_line();

const std::vector<Pattern>& all_patterns() {
  static const std::vector<Pattern> all = {
      make_message(),     make_soft(),      make_both_ways(),       make_unicast(),
      make_pipeline(),    make_sources(),   make_broadcast(),       make_request(),
      make_alternative(), make_interrupt(), make_traffic(),         make_task_farm(),
      make_law(),         make_commstime(), make_flops(),           make_metrics(),
      make_census(),      make_deadlock(),  make_global_messages(), make_random_traffic(),
      make_router_load(), make_soak(),      make_in_path(),         make_data(),
      make_radiosity(),   make_scan_line(),
  };
  return all;
}

namespace {

[[noreturn]] void throw_unfinished(const machine::Machine& machine, machine::End end) {
  throw Unfinished(
      "machine", machine.now(),
      fmt::format("the run was ended at {:.6f} s ({})", machine.now().value, to_string(end)));
}

}  // namespace

void run_machine(const Setup& setup, machine::Machine& machine) {
  observe::Watch none;
  const machine::End end = observe::run(machine, setup.watch ? *setup.watch : none);
  if (end != machine::End::done) throw_unfinished(machine, end);
}

void run_machine_until(const Setup& setup, machine::Machine& machine, machine::Seconds date) {
  observe::Watch none, &watch = setup.watch ? *setup.watch : none;
  const auto asked = watch.until;
  watch.until = std::min(asked, date);
  const machine::End end = observe::run(machine, watch);
  watch.until = asked;
  const bool reached = end == machine::End::limit && machine.now() >= date;
  if (end != machine::End::done && !reached) throw_unfinished(machine, end);
  watch.end = machine::End::done;
}

double Setup::operator[](std::string_view name) const {
  const auto found = parameters.find(name);
  if (found == parameters.end())
    throw base::InvariantBroken(fmt::format("the pattern has no parameter {}", name));
  return found->second;
}

std::int64_t Setup::whole(std::string_view name) const { return std::llround((*this)[name]); }

std::string Setup::choice(std::string_view name) const {
  const auto value = static_cast<std::size_t>(whole(name));
  if (pattern)
    if (const auto found = std::ranges::find(pattern->parameters, name, &Parameter::name);
        found != pattern->parameters.end() && value < found->choices.size())
      return found->choices[value];
  throw base::InvariantBroken(fmt::format("the pattern has no choice {}", name));
}

const std::string& Setup::path(std::string_view name) const {
  const auto found = files.find(name);
  if (found == files.end())
    throw base::InvariantBroken(fmt::format("the pattern has no path {}", name));
  return found->second.path;
}

Parameter make_path(const std::string& name, const std::string& help, bool is_required) {
  return {name, 0, 0, 0, false, help, {}, true, is_required};
}

Parameter make_choice(const std::string& name, const std::vector<std::string>& choices,
                      const std::string& help) {
  return {name, 0, 0, static_cast<double>(choices.size()) - 1, true, help, choices};
}

}  // namespace programs
