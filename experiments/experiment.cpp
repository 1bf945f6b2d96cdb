#include "experiments/experiment.hpp"

#include <toml++/toml.h>

#include <filesystem>
#include <fstream>
#include <sstream>

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

std::string to_toml(const toml::node& node) {
  std::ostringstream text;
  node.visit([&](const auto& n) { text << n; });
  return text.str();
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

// "scene.objects=800". What is not TOML is taken for a text.
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
  assign(file, key, *parsed.get("value"));
}

struct Axis {
  std::string name, key;
  std::vector<const toml::node*> values;
};

std::vector<Axis> read_axes(const toml::table& file, const std::string& origin) {
  std::vector<Axis> axes;
  const auto* node = file.get("sweep");
  if (!node) return axes;
  if (!node->is_table())
    throw InvalidInput(fmt::format("{}: sweep: expected a section of axes", origin));
  for (auto&& [name, values] : *node->as_table()) {
    const Place at{origin, fmt::format("sweep.{}", name.str()), "", values};
    Axis axis{std::string(name.str()), key_of_axis(name.str(), origin), {}};
    const auto* list = values.as_array();
    if (!list || list->empty()) at.refuse("an array of values");
    for (const auto& value : *list) axis.values.push_back(&value);
    axes.push_back(axis);
  }
  // In the order of the file; TOML tables are sorted by name.
  std::ranges::sort(axes, {}, [](const Axis& a) {
    const auto& source = a.values.front()->source().begin;
    return std::pair(source.line, source.column);
  });
  return axes;
}

}  // namespace

ExperimentFile load_experiment(const std::string& path, const std::vector<std::string>& overrides) {
  std::ifstream in(path);
  if (!in || !std::filesystem::is_regular_file(path))
    throw InvalidInput(fmt::format("{}: the experiment file cannot be read", path));
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  toml::table file = parse(text, path);
  for (const auto& override : overrides) override_key(file, override);

  const std::string folder = std::filesystem::path(path).parent_path().string();
  const auto axes = read_axes(file, path);
  ExperimentFile experiment{path, to_toml(file), {}, {}};
  std::size_t points = 1;
  for (const auto& axis : axes) {
    experiment.axes.push_back(axis.name);
    points *= axis.values.size();
    if (points > MAX_POINTS)
      throw InvalidInput(fmt::format("{}: [sweep] spans more than {} points", path, MAX_POINTS));
  }
  for (std::size_t i = 0; i < points; ++i) {
    Point point;
    std::vector<Replacement> replacements;
    std::size_t rest = i;
    for (auto axis = axes.rbegin(); axis != axes.rend(); ++axis) {
      const toml::node& value = *axis->values[rest % axis->values.size()];
      rest /= axis->values.size();
      replacements.push_back({axis->key, &value});
      point.at.insert(point.at.begin(), {axis->name, to_toml(value)});
    }
    point.experiment = bind_settings(file, replacements, path, folder);
    experiment.points.push_back(std::move(point));
  }
  return experiment;
}

}  // namespace experiments
