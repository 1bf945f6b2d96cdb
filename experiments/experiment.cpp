#include "experiments/experiment.hpp"

#include <toml++/toml.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <tuple>

#include "experiments/program.hpp"
#include "experiments/schema.hpp"
#include "experiments/values.hpp"
#include "simulator/machine/faults.hpp"

namespace experiments {

namespace {

using machine::InvalidInput;

constexpr std::size_t MAX_POINTS = 100'000;

toml::table parse(std::string_view text, const std::string& origin) {
  try {
    return toml::parse(text, origin);
  } catch (const toml::parse_error& error) {
    throw InvalidInput(
        fmt::format("{}:{}: {}", origin, error.source().begin.line, error.description()));
  }
}

// Sets a dotted key, making the sections it names.
void assign(toml::table& file, std::string_view key, const toml::node& value) {
  toml::table* section = &file;
  for (auto dot = key.find('.'); dot != std::string_view::npos; dot = key.find('.')) {
    auto [place, added] = section->insert(key.substr(0, dot), toml::table{});
    section = place->second.as_table();
    if (!section) throw InvalidInput(fmt::format("{}: not a section", key.substr(0, dot)));
    key.remove_prefix(dot + 1);
  }
  section->insert_or_assign(key, value);
}

// "scene.objects=800". What is not TOML is taken for a text. An axis has a name, dots or not.
void override_key(toml::table& file, const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw InvalidInput(fmt::format("--set {}: expected key.path=value", text));
  const std::string key = text.substr(0, equals), value = text.substr(equals + 1);
  toml::table parsed;
  try {
    parsed = toml::parse("value = " + value, "--set " + text);
  } catch (const toml::parse_error&) {
    parsed.insert("value", value);
  }
  if (parsed.size() != 1)
    throw InvalidInput(fmt::format("--set {}: expected one value after '='", text));
  if (!key.starts_with("sweep.")) return assign(file, key, *parsed.get("value"));
  auto* sweep = file.insert("sweep", toml::table{}).first->second.as_table();
  if (!sweep) throw InvalidInput("sweep: not a section");
  sweep->insert_or_assign(key.substr(6), *parsed.get("value"));
}

// The axes of [sweep] as a flat table: names with dots may stand there with or without quotes.
void flatten(toml::table& from, const std::string& prefix, toml::table& into) {
  for (auto&& [name, node] : from) {
    const auto dotted = prefix + std::string(name.str());
    if (auto* table = node.as_table())
      flatten(*table, dotted + ".", into);
    else
      node.visit([&](auto& value) { into.insert(dotted, std::move(value)); });  // keeps its line
  }
}

toml::table* flatten_sweep(toml::table& file, const std::string& origin) {
  auto* node = file.get("sweep");
  if (!node) return nullptr;
  if (!node->is_table())
    throw InvalidInput(fmt::format("{}: sweep: expected a section of axes", origin));
  toml::table flat;
  flatten(*node->as_table(), "", flat);
  *node->as_table() = std::move(flat);
  return node->as_table();
}

// Adds the names of the axes that are new, in the order of the file. (TOML tables are sorted by
// name.)
void add_names(std::vector<std::string>& order, toml::table& file, const std::string& origin) {
  const auto* sweep = flatten_sweep(file, origin);
  if (!sweep) return;
  std::vector<std::tuple<unsigned, unsigned, std::string>> found;
  for (auto&& [name, values] : *sweep) {
    const auto& source = values.source().begin;
    found.emplace_back(source.line, source.column, std::string(name.str()));
  }
  std::ranges::sort(found);
  for (const auto& [line, column, name] : found)
    if (std::ranges::find(order, name) == order.end()) order.push_back(name);
}

// 2 and 2.0 are one value.
void check_different(const Axis& axis, const Place& at) {
  std::set<std::string> known;
  for (const auto* value : axis.values) {
    const auto number = value->value<double>();
    const bool is_number = value->is_number() && std::abs(*number) < 0x1p53;
    if (!known.insert(is_number ? fmt::format("{}", *number) : to_toml(*value)).second)
      at.refuse(fmt::format("each value once, {} is there twice", to_toml(*value)));
  }
}

std::vector<Axis> read_axes(const toml::table& file, const std::vector<std::string>& order,
                            const std::string& origin) {
  std::vector<Axis> axes;
  const auto* sweep = file["sweep"].as_table();
  if (!sweep) return axes;
  const auto program = read_program(file, origin);
  for (const auto& name : order) {
    if (!sweep->contains(name)) continue;  // --set has replaced the section
    const toml::node& values = *sweep->get(name);
    const Place at{origin, "sweep." + name, "", values};
    Axis axis = name_axis(name, program, origin);
    if (std::ranges::find(axes, axis.key, &Axis::key) != axes.end())
      at.refuse("each axis once, " + axis.key + " is there already");
    const auto* list = values.as_array();
    if (!list || list->empty()) at.refuse("an array of values, at least one");
    for (const auto& value : *list) axis.values.push_back(&value);
    check_different(axis, at);
    axes.push_back(std::move(axis));
  }
  return axes;
}

// What the file gives, then what an axis gives in its place.
std::map<std::string, double, std::less<>> find_numbers(
    const toml::table& file, const std::vector<Replacement>& replacements) {
  std::map<std::string, double, std::less<>> numbers;
  auto add = [&](const std::string& key, const toml::node& node) {
    if (key.starts_with("model.")) return;  // the machine model has them, by their own names
    if (node.is_number())
      numbers[key] = *node.value<double>();
    else
      numbers.erase(key);
  };
  for_each_key(file, add);
  for (const auto& [key, value] : replacements) add(key, *value);
  return numbers;
}

// An axis takes the place of its key: what is set there would change nothing.
void check_not_shadowed(const std::string& override, const std::vector<Axis>& axes) {
  const auto key = override.substr(0, override.find('='));
  for (const auto& axis : axes)
    if (axis.key == key)
      throw InvalidInput(
          fmt::format("--set {}: {} is an axis of [sweep], expected "
                      "--set 'sweep.{}=[...]'",
                      override, key, axis.name));
}

// The file without what says nothing about what a point does.
std::map<std::string, std::string> find_settings(const toml::table& file) {
  std::map<std::string, std::string> settings;
  for_each_key(file, [&](const std::string& key, const toml::node& node) {
    const auto section = key.substr(0, key.find('.'));
    for (const char* name : {"title", "question", "plot", "report"})
      if (section == name) return;
    settings[key] = to_toml(node);
  });
  return settings;
}

// With the axes in the order of the sweep: a table sorts them by name.
std::string resolve(const toml::table& file, const std::vector<Axis>& axes,
                    const std::string& program, const std::string& origin) {
  if (axes.empty()) return to_toml(file);
  toml::table rest = file;
  rest.erase("sweep");
  std::string text = to_toml(rest) + "\n\n[sweep]";
  for (const auto& axis : axes) {
    const bool is_short =
        !axis.key.starts_with("model.") && name_axis(axis.name, program, origin).key == axis.key;
    std::string values;
    for (const auto* value : axis.values) values += (values.empty() ? "" : ", ") + to_toml(*value);
    text +=
        fmt::format("\n{} = [{}]", is_short ? axis.name : fmt::format("\"{}\"", axis.key), values);
  }
  return text;
}

std::size_t count_points(const std::vector<Axis>& axes, const std::string& path) {
  double points = 1;
  for (const auto& axis : axes) points *= static_cast<double>(axis.values.size());
  if (points > MAX_POINTS)
    throw InvalidInput(fmt::format(
        "{}: [sweep] spans {} points, expected at most {}", path,
        points < 1e15 ? fmt::format("{:.0f}", points) : fmt::format("{:.3g}", points), MAX_POINTS));
  return static_cast<std::size_t>(points);
}

// The last axis runs fastest.
Point make_point(const toml::table& file, const std::vector<Axis>& axes, std::size_t number,
                 const std::string& path, const std::string& folder) {
  Point point;
  std::vector<Replacement> replacements;
  for (auto axis = axes.rbegin(); axis != axes.rend(); ++axis) {
    const toml::node& value = *axis->values[number % axis->values.size()];
    number /= axis->values.size();
    replacements.push_back({axis->key, &value});
    point.at.insert(point.at.begin(), {axis->name, to_toml(value)});
  }
  point.experiment = bind_settings(file, replacements, path, folder);
  point.numbers = find_numbers(file, replacements);
  return point;
}

}  // namespace

ExperimentFile load_experiment(const std::string& path, const std::vector<std::string>& overrides) {
  std::ifstream in(path);
  if (!in || !std::filesystem::is_regular_file(path))
    throw InvalidInput(fmt::format("{}: the experiment file cannot be read", path));
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return read_experiment(text, path, std::filesystem::path(path).parent_path().string(), overrides);
}

ExperimentFile read_experiment(const std::string& text, const std::string& path,
                               const std::string& folder,
                               const std::vector<std::string>& overrides) {
  toml::table file = parse(text, path);
  std::vector<std::string> order;
  add_names(order, file, path);
  for (const auto& override : overrides) {
    override_key(file, override);
    add_names(order, file, path);
  }

  const auto axes = read_axes(file, order, path);
  for (const auto& override : overrides) check_not_shadowed(override, axes);
  ExperimentFile experiment{path,
                            resolve(file, axes, read_program(file, path), path),
                            {},
                            {},
                            read_definitions(file, path),
                            read_checks(file, path, folder)};
  for (const auto& axis : axes) {
    experiment.axes.push_back(axis.name);
    experiment.axis_keys.push_back(axis.key);
  }
  experiment.settings = find_settings(file);
  const std::size_t points = count_points(axes, path);
  for (std::size_t i = 0; i < points; ++i)
    experiment.points.push_back(make_point(file, axes, i, path, folder));
  return experiment;
}

std::string name_of(const Point& point) {
  std::string name;
  for (const auto& at : point.at)
    name += fmt::format("{}{} = {}", name.empty() ? "" : ", ", at.axis, at.toml);
  return name;
}

}  // namespace experiments
