#include "experiments/laboratory/file/program.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/errors.hpp"
#include "base/spelling.hpp"

namespace laboratory {

using base::BadInput;
using programs::Parameter;
using programs::Pattern;

const Pattern* find_pattern(std::string_view program) {
  const auto found = std::ranges::find(programs::all_patterns(), program, &Pattern::name);
  return found == programs::all_patterns().end() ? nullptr : &*found;
}

std::string read_program(const toml::table& file, const std::string& origin) {
  const auto node = file["program"]["name"];
  if (!node) return "farm";
  const Place at{origin, "program.name", "", *node.node()};
  const std::string name = read_text(at);
  if (name == "farm" || find_pattern(name)) return name;
  std::vector<std::string> known{"farm"};
  for (const auto& pattern : programs::all_patterns()) known.push_back(pattern.name);
  at.refuse(fmt::format("one of {} (did you mean \"{}\"?)", fmt::join(known, ", "),
                        base::nearest_name(name, known)));
}

std::string describe_value(const Parameter& parameter, double value) {
  return parameter.choices.empty() ? fmt::format("{}", value)
                                   : parameter.choices.at(static_cast<std::size_t>(value));
}

std::string describe_value(const Parameter& parameter, const Experiment& experiment) {
  if (!parameter.is_path)
    return describe_value(parameter, experiment.parameters.at(parameter.name));
  const auto& text = experiment.files.at(parameter.name).text;
  return text.empty() ? "none" : text;
}

void check_files(const Experiment& experiment) {
  for (const auto& p : find_pattern(experiment.program)->parameters) {
    if (!p.is_path) continue;
    const auto& file = experiment.files.at(p.name);
    if (file.path.empty() && p.is_required)
      throw BadInput(fmt::format("program.{}: found none, expected a file: {}", p.name, p.help));
    if (!file.path.empty() && !std::filesystem::is_regular_file(file.path))
      throw BadInput(fmt::format("program.{}: found \"{}\", expected a file: there is none at {}",
                                 p.name, file.text, file.path));
  }
}

namespace {

programs::NamedFile read_file_name(const Place& at) {
  const auto text = read_text(at);
  return {text, text.empty() ? "" : (std::filesystem::path(at.folder) / text).string()};
}

double read_choice(const std::vector<std::string>& choices, const Place& at) {
  const auto text = at.node.value_exact<std::string>();
  const auto found = text ? std::ranges::find(choices, *text) : choices.end();
  if (found != choices.end()) return static_cast<double>(found - choices.begin());
  at.refuse(fmt::format(
      "one of {}{}", fmt::join(choices, ", "),
      text ? fmt::format(" (did you mean \"{}\"?)", base::nearest_name(*text, choices)) : ""));
}

}  // namespace

void bind_parameter(Experiment& experiment, const Pattern& pattern, const Place& at) {
  const auto name = at.key.substr(at.key.find('.') + 1);
  const auto found = std::ranges::find(pattern.parameters, name, &Parameter::name);
  if (found == pattern.parameters.end()) {
    std::vector<std::string> known;
    for (const auto& p : pattern.parameters) known.push_back("program." + p.name);
    throw BadInput(fmt::format(
        "{}: unknown key \"{}\", {}", at.where(), at.key,
        known.empty()
            ? fmt::format("the program {} has no parameters", pattern.name)
            : fmt::format("the nearest valid key is \"{}\"", base::nearest_name(at.key, known))));
  }
  if (found->is_path) {
    experiment.files[name] = read_file_name(at);
    return;
  }
  if (!found->choices.empty()) {
    experiment.parameters[name] = read_choice(found->choices, at);
    return;
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
      throw BadInput(
          fmt::format("{}: {}: the program {} has a network of its own, expected no "
                      "[network]",
                      at.where(), key, pattern.name));
    return;
  }
  const auto section = key.substr(0, key.find('.'));
  if (key.starts_with("machine.") && key != "machine.model")
    throw BadInput(fmt::format("{}: {} is a key of the farm, but program.name is \"{}\"",
                               at.where(), key, pattern.name));
  for (const char* farms : {"scene", "image", "farm", "data", "stage", "order"})
    if (section == farms)
      throw BadInput(fmt::format("{}: {} is a key of the farm, but program.name is \"{}\"",
                                 at.where(), key, pattern.name));
}

void check_used(const Pattern* pattern, const Place& at) {
  const auto refuse = [&](const char* what, bool Pattern::*uses) {
    if (pattern && pattern->*uses) return;
    std::vector<std::string> users;
    for (const auto& other : programs::all_patterns())
      if (other.*uses) users.push_back(other.name);
    throw BadInput(fmt::format(
        "{}: {}: the program {} has no use for {}, expected {}", at.where(), at.key,
        pattern ? pattern->name : "farm", what,
        users.empty() ? "nothing of the kind" : fmt::format("one of {}", fmt::join(users, ", "))));
  };
  for (const char* key : {"network.routes", "network.tree", "network.tree_links"})
    if (at.key == key) refuse("routes and trees", &Pattern::uses_routes);
  if (at.key == "fault") refuse("faults", &Pattern::uses_faults);
  if (pattern && at.key == "run.cost" && at.node.value_exact<std::string>() == "timed")
    refuse("timed costs", &Pattern::uses_cost);
}

}  // namespace laboratory
