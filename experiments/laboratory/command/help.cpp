#include "experiments/laboratory/command/help.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

namespace laboratory {
namespace {

constexpr std::size_t ABOUT_COLUMN = 30;  // column at which descriptions begin

// Formats "  NAME   ABOUT". If the name is long, the description is on the next line.
std::string line_of(const std::string& name, const std::string& about) {
  std::string line = "  " + name;
  if (about.empty()) return line + "\n";
  if (line.size() >= ABOUT_COLUMN) line += "\n" + std::string(ABOUT_COLUMN, ' ');
  return fmt::format("{:<{}}{}\n", line, ABOUT_COLUMN, about);
}

std::string conditions(const char* label, const std::set<CLI::Option*>& options) {
  std::set<std::string> names;
  for (const auto* option : options) names.insert(option->get_name());
  return names.empty() ? "" : fmt::format(" {}: {}", label, fmt::join(names, " "));
}

// Text after an option's name: the option's own text if it has one, else type, default and
// conditions.
std::string values_of(const CLI::Option& option) {
  if (!option.get_option_text().empty()) return " " + option.get_option_text();
  std::string text;
  if (option.get_type_size() != 0) {
    if (!option.get_type_name().empty()) text += " " + option.get_type_name();
    if (!option.get_default_str().empty()) text += "=" + option.get_default_str();
    if (option.get_expected_max() == CLI::detail::expected_max_vector_size) text += " ...";
    if (option.get_required()) text += " REQUIRED";
  }
  return text + conditions("Needs", option.get_needs()) +
         conditions("Excludes", option.get_excludes());
}

std::string group_of(const char* title, const std::vector<const CLI::Option*>& options,
                     bool are_positional) {
  if (options.empty()) return "";
  std::string text = fmt::format("\n{}:\n", title);
  for (const auto* option : options)
    text += line_of(option->get_name(are_positional, !are_positional) + values_of(*option),
                    option->get_description());
  return text;
}

std::string usage_of(const CLI::App& app, const std::string& name,
                     const std::vector<const CLI::Option*>& positionals) {
  std::string text = fmt::format("Usage: {} [OPTIONS]", name);
  for (const auto* option : positionals)
    text +=
        fmt::format(fmt::runtime(option->get_required() ? " {}{}" : " [{}{}]"),
                    option->get_name(true, false), option->get_expected_max() > 1 ? " ..." : "");
  return text + (app.get_subcommands({}).empty() ? "\n" : " SUBCOMMAND\n");
}

}  // namespace

std::string Help::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode) const {
  const auto positionals = app->get_options([](const auto* o) { return o->get_positional(); });
  const auto others = app->get_options([](const auto* o) { return o->nonpositional(); });
  std::string text = app->get_description() + "\n" + usage_of(*app, name, positionals) +
                     group_of("Positionals", positionals, true) +
                     group_of("Options", others, false);
  const auto commands = app->get_subcommands({});
  if (!commands.empty()) text += "\nSubcommands:\n";
  for (const auto* command : commands)
    text += line_of(command->get_name(), command->get_description());
  return app->get_footer().empty() ? text : text + "\n" + app->get_footer() + "\n";
}

}  // namespace laboratory
