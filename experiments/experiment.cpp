#include "experiments/experiment.hpp"

#include <toml++/toml.h>

#include <filesystem>
#include <fstream>
#include <ranges>
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

// "workers, height" however it is spelled.
std::string join_names(std::string_view name) {
  return fmt::format("{}", fmt::join(split_names(name), ", "));
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
  sweep->insert_or_assign(join_names(key.substr(6)), *parsed.get("value"));
}

// The axes of [sweep] as a flat table: names with dots may stand there with or without quotes.
void flatten(toml::table& from, const std::string& prefix, toml::table& into) {
  for (auto&& [name, node] : from) {
    const auto dotted = prefix + std::string(name.str());
    if (auto* table = node.as_table())
      flatten(*table, dotted + ".", into);
    else
      node.visit([&](auto& value) {
        into.insert(join_names(dotted), std::move(value));
      });  // with its line
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

// Axes that go together: one, but for "workers, height" = [[1, 16], ...].
using Coupled = std::vector<Axis>;

// The values of each axis, of a list of values or, for several axes, of lists of one of each.
void read_values(Coupled& axes, const Place& at) {
  const auto* list = at.node.as_array();
  if (!list || list->empty()) at.refuse("an array of values");
  for (const auto& entry : *list) {
    const auto* values = entry.as_array();
    if (axes.size() > 1 && (!values || values->size() != axes.size()))
      Place{at.origin, at.key, "", entry}.refuse(fmt::format(
          "an array of {} values, {}", axes.size(), at.key.substr(at.key.find('.') + 1)));
    for (std::size_t i = 0; i < axes.size(); ++i)
      axes[i].values.push_back(axes.size() > 1 ? values->get(i) : &entry);
  }
}

std::vector<Coupled> read_axes(const toml::table& file, const std::vector<std::string>& order,
                               const std::string& origin) {
  std::vector<Coupled> all;
  std::set<std::string> keys;
  const auto* sweep = file["sweep"].as_table();
  if (!sweep) return all;
  const auto program = read_program(file, origin);
  for (const auto& names : order) {
    if (!sweep->contains(names)) continue;  // --set has replaced the section
    const Place at{origin, "sweep." + names, "", *sweep->get(names)};
    Coupled axes;
    for (const auto& name : split_names(names)) {
      axes.push_back(name_axis(name, program, origin));
      if (!keys.insert(axes.back().key).second)
        at.refuse("each axis once, " + axes.back().key + " is there already");
    }
    read_values(axes, at);
    all.push_back(std::move(axes));
  }
  return all;
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
void check_not_shadowed(const std::string& override, const std::vector<Coupled>& axes) {
  const auto key = override.substr(0, override.find('='));
  for (const auto& coupled : axes)
    for (const auto& axis : coupled)
      if (axis.key == key)
        throw InvalidInput(fmt::format(
            "--set {}: {} is an axis of [sweep], expected "
            "--set 'sweep.{}=[...]'",
            override, key, fmt::join(coupled | std::views::transform(&Axis::name), ", ")));
}

std::size_t count_points(const std::vector<Coupled>& axes, const std::string& path) {
  std::size_t points = 1;
  for (const auto& coupled : axes) {
    points *= coupled[0].values.size();
    if (points > MAX_POINTS)
      throw InvalidInput(fmt::format("{}: [sweep] spans more than {} points", path, MAX_POINTS));
  }
  return points;
}

// The point of that number; the last axis runs fastest.
Point make_point(const toml::table& file, const std::vector<Coupled>& axes, std::size_t number,
                 const std::string& path, const std::string& folder) {
  Point point;
  std::vector<Replacement> replacements;
  for (const auto& coupled : std::views::reverse(axes)) {
    const auto count = coupled[0].values.size();
    for (const auto& axis : std::views::reverse(coupled)) {
      const toml::node& value = *axis.values[number % count];
      replacements.push_back({axis.key, &value});
      point.at.insert(point.at.begin(), {axis.name, to_toml(value)});
    }
    number /= count;
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
  toml::table file = parse(text, path);
  std::vector<std::string> order;
  add_names(order, file, path);
  for (const auto& override : overrides) {
    override_key(file, override);
    add_names(order, file, path);
  }

  const std::string folder = std::filesystem::path(path).parent_path().string();
  const auto axes = read_axes(file, order, path);
  for (const auto& override : overrides) check_not_shadowed(override, axes);
  ExperimentFile experiment{
      path, to_toml(file), {}, {}, read_definitions(file, path), read_checks(file, path, folder)};
  experiment.plots = read_plots(file, path, folder);
  experiment.bests = read_bests(file, path);
  experiment.report = read_report(file, path);
  for (const auto& coupled : axes) {
    std::vector<std::string> names;
    for (const auto& axis : coupled) names.push_back(axis.name);
    std::ranges::copy(names, std::back_inserter(experiment.axes));
    if (names.size() > 1) experiment.coupled.push_back(std::move(names));
  }
  const auto points = count_points(axes, path);
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
