#include "experiments/program.hpp"

#include <algorithm>
#include <cmath>

#include "simulator/machine/faults.hpp"
#include "topologies/spelling.hpp"

namespace experiments {

using machine::InvalidInput;
using patterns::Parameter;
using patterns::Pattern;

const Pattern* find_pattern(std::string_view program) {
  const auto found = std::ranges::find(patterns::all_patterns(), program, &Pattern::name);
  return found == patterns::all_patterns().end() ? nullptr : &*found;
}

std::string read_program(const toml::table& file, const std::string& origin) {
  const auto node = file["program"]["name"];
  if (!node) return "farm";
  const Place at{origin, "program.name", "", *node.node()};
  const std::string name = read_text(at);
  if (name == "farm" || find_pattern(name)) return name;
  std::vector<std::string> known{"farm"};
  for (const auto& pattern : patterns::all_patterns()) known.push_back(pattern.name);
  at.refuse(fmt::format("one of {} (did you mean \"{}\"?)", fmt::join(known, ", "),
                        topologies::nearest_name(name, known)));
}

void bind_parameter(Experiment& experiment, const Pattern& pattern, const Place& at) {
  const auto name = at.key.substr(at.key.find('.') + 1);
  const auto found = std::ranges::find(pattern.parameters, name, &Parameter::name);
  if (found == pattern.parameters.end()) {
    std::vector<std::string> known;
    for (const auto& p : pattern.parameters) known.push_back("program." + p.name);
    throw InvalidInput(
        fmt::format("{}: unknown key \"{}\", {}", at.where(), at.key,
                    known.empty() ? fmt::format("the program {} has no parameters", pattern.name)
                                  : fmt::format("the nearest valid key is \"{}\"",
                                                topologies::nearest_name(at.key, known))));
  }
  const auto value = at.node.is_number() ? at.node.value<double>() : std::nullopt;
  if (!value || !(*value >= found->low && *value <= found->high) ||
      (found->whole && *value != std::floor(*value)))
    at.refuse(fmt::format("a {} from {} to {}", found->whole ? "whole number" : "number",
                          found->low, found->high));
  experiment.parameters[name] = *value;
}

void bind_model_entry(Experiment& experiment, const Place& at) {
  if (!at.node.is_number() && !at.node.is_string()) at.refuse("a number, or a formula in quotes");
  const auto entry = at.key.substr(at.key.find('.') + 1);
  auto& overrides = experiment.model_overrides;
  const auto known =
      std::ranges::find(overrides, entry, &std::pair<std::string, std::string>::first);
  if (known != overrides.end())
    known->second = to_toml(at.node);
  else
    overrides.emplace_back(entry, to_toml(at.node));
}

void check_belongs(const Pattern& pattern, const Place& at) {
  const auto& key = at.key;
  if (key.starts_with("network.")) {
    if (!pattern.uses_topology)
      throw InvalidInput(
          fmt::format("{}: {}: the program {} has a network of its own, expected no "
                      "[network]",
                      at.where(), key, pattern.name));
    return;
  }
  const auto section = key.substr(0, key.find('.'));
  if (key.starts_with("machine.") && key != "machine.model")
    throw InvalidInput(fmt::format("{}: {} is a key of the farm, but program.name is \"{}\"",
                                   at.where(), key, pattern.name));
  for (const char* farms : {"scene", "image", "farm", "stage", "order"})
    if (section == farms)
      throw InvalidInput(fmt::format("{}: {} is a key of the farm, but program.name is \"{}\"",
                                     at.where(), key, pattern.name));
}

}  // namespace experiments
