#include "experiments/laboratory/guide/keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiments/laboratory/file/experiment.hpp"

namespace laboratory {
namespace {

std::string describe_field(const programs::Parameter& field, const std::string& key,
                           const std::any& defaults) {
  const auto kind = field.domain.kind;
  std::string text = fmt::format("    {:<28} {}", key, field.help);
  if (!field.unit.empty()) text += "; " + field.unit;
  if (kind == base::Domain::Kind::choice)
    text += fmt::format("; one of {}", fmt::join(field.domain.choices, ", "));
  if (kind == base::Domain::Kind::whole || kind == base::Domain::Kind::number)
    text += fmt::format("; {}{}..{}", kind == base::Domain::Kind::whole ? "whole, " : "",
                        field.domain.low, field.domain.high);
  if (kind == base::Domain::Kind::flag) text += "; true or false";
  if (kind == base::Domain::Kind::file) text += "; a file";
  if (!field.domain.is_required) text += fmt::format(" [{}]", to_text(field.get(defaults)));
  return text + "\n";
}

}  // namespace

std::string describe_keys() {
  std::string text =
      "Keys of the experiment file (any but those of stage, order, fault, let and check can be an "
      "axis\nof [sweep]):\n";
  for (const auto& setting : settings())
    text += fmt::format("  {:<30} {}\n", setting.key, setting.help);
  return text;
}

std::string describe_program(const programs::Program& program) {
  std::string text = fmt::format("  {:<30} {}\n", program.name, program.help);
  for (const auto& p : program.parameters)
    text += describe_field(p, programs::key_of(p), program.defaults);
  for (const auto& list : program.lists) {
    text += fmt::format("    {:<28} {}\n", list.key, list.help);
    const auto record = list.make_record();
    for (const auto& field : list.fields)
      text += describe_field(field, list.key + "." + field.name, record);
  }
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
