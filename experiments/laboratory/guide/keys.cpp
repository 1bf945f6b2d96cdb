#include "experiments/laboratory/guide/keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "experiments/laboratory/file/experiment.hpp"

namespace laboratory {
namespace {

// One line of help: the key, its meaning, unit, values and default.
std::string describe(const Setting& setting, int indent) {
  const auto& [key, help, unit, domain, standard] = setting;
  const bool is_whole = domain.kind == base::Domain::Kind::whole;
  std::string text = fmt::format("{:{}}{:<{}} {}", "", indent, key, 32 - indent, help);
  if (!unit.empty()) text += "; " + unit;
  if (domain.kind == base::Domain::Kind::choice)
    text += fmt::format("; one of {}", fmt::join(domain.choices, ", "));
  constexpr double LARGEST_SHOWN = 9e18;  // a larger limit only reflects the integer type
  if (is_whole || domain.kind == base::Domain::Kind::number)
    text += fmt::format("; {}{}", is_whole ? "whole, " : "",
                        domain.high < LARGEST_SHOWN ? fmt::format("{}..{}", domain.low, domain.high)
                                                    : fmt::format("at least {}", domain.low));
  if (domain.kind == base::Domain::Kind::flag) text += "; true or false";
  if (domain.kind == base::Domain::Kind::file) text += "; a file";
  const auto value = describe_default(domain, standard);
  if (!domain.is_required && domain.kind != base::Domain::Kind::any && !value.empty())
    text += fmt::format(" [{}]", value);
  return text + "\n";
}

// All keys of a program, including those of its lists such as [[stage]].
std::vector<Setting> settings_of(const programs::Program& program) {
  std::vector<Setting> all;
  for (const auto& p : program.parameters)
    all.push_back({programs::key_of(p), p.help, p.unit, p.domain, p.get(program.defaults)});
  for (const auto& list : program.lists) {
    all.push_back({list.key, list.help});
    add_settings(all, list.fields, list.key + ".", list.make_record());
  }
  return all;
}

bool is_named(const std::string& key, const std::string& word) {
  const auto last = key.substr(key.rfind('.') + 1);
  return (key.starts_with(word + ".") && word != "program") || last == word || key == word ||
         last.ends_with("_" + word);
}

}  // namespace

std::string describe_keys() {
  std::string text =
      "Keys of the experiment file (any but those of stage, order, fault, let and check can be an "
      "axis\nof [sweep]):\n";
  for (const auto& setting : settings()) text += describe(setting, 2);
  return text;
}

std::string describe_keys_of(const std::string& word) {
  std::string text;
  for (const auto& setting : settings())
    if (is_named(setting.key, word)) text += describe(setting, 2);
  // each with the programs that have its key
  std::vector<std::pair<std::string, std::vector<std::string>>> lines;
  for (const auto& program : programs::all_programs())
    for (const auto& setting : settings_of(program)) {
      if (program.name == word || !is_named(setting.key, word)) continue;
      const auto line = describe(setting, 2);
      auto found = std::ranges::find(lines, line, &decltype(lines)::value_type::first);
      if (found == lines.end()) found = lines.insert(lines.end(), {line, {}});
      found->second.push_back(program.name);
    }
  for (const auto& [line, names] : lines)
    text += fmt::format("{}; of {}\n", line.substr(0, line.size() - 1), fmt::join(names, ", "));
  return text;
}

std::string describe_program(const programs::Program& program) {
  std::string text = fmt::format("  {:<30} {}\n", program.name, program.help);
  for (const auto& setting : settings_of(program)) text += describe(setting, 4);
  return text;
}

std::string describe_programs() {
  std::string text = "Programs (program.name):\n";
  for (const auto& program : programs::all_programs()) text += describe_program(program);
  return text;
}

std::string describe_columns(const programs::Program& program) {
  std::string text = fmt::format("{}: {}\n", program.name, program.help);
  for (const auto& [name, help] : program.columns) text += fmt::format("  {:<26} {}\n", name, help);
  return text;
}

}  // namespace laboratory
