#include "experiments/laboratory/file/experiment.hpp"

#include <filesystem>
#include <ranges>

#include "base/errors.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/file/schema.hpp"
#include "experiments/laboratory/file/sweep.hpp"
#include "experiments/laboratory/file/tables.hpp"
#include "experiments/laboratory/file/values.hpp"

namespace laboratory {
namespace {

using base::BadInput;

// Sets the value of a key with dots in a TOML table, and creates missing sections.
void assign(toml::table& file, std::string_view key, const toml::node& value) {
  toml::table* section = &file;
  for (auto dot = key.find('.'); dot != std::string_view::npos; dot = key.find('.')) {
    auto [place, added] = section->insert(key.substr(0, dot), toml::table{});
    section = place->second.as_table();
    base::require(section, key.substr(0, dot), "not a section");
    key.remove_prefix(dot + 1);
  }
  section->insert_or_assign(key, value);
}

// Sets a key of the file. The key may name axes, as in "sweep.topology, workers".
void set_key(toml::table& file, const std::string& key, const toml::node& value) {
  if (!key.starts_with("sweep.")) return assign(file, key, value);
  auto* sweep = file.insert("sweep", toml::table{}).first->second.as_table();
  base::require(sweep, "sweep", "not a section");
  sweep->insert_or_assign(join_names(key.substr(6)), value);
}

// Sets keys of the file to the values in the table `by` and its subtables. `prefix` is put before
// the name of each key.
void replace_keys(toml::table& file, const toml::table& by, const std::string& prefix) {
  for (auto&& [name, node] : by) {
    const auto key = prefix + std::string(name.str());
    if (const auto* table = node.as_table())
      replace_keys(file, *table, key + ".");
    else
      set_key(file, key, node);
  }
}

// Removes [reduced] from the file. If `is_reduced`, first sets the keys of the file to its values.
void take_reduced(toml::table& file, bool is_reduced, const std::string& path) {
  const auto* node = file.get("reduced");
  if (!node) return;
  base::require(node->is_table(), path, "reduced: expected a section");
  const toml::table reduced = *node->as_table();
  file.erase("reduced");
  if (is_reduced) replace_keys(file, reduced, "");
}

// Collects the numeric values of all keys at one point of the sweep. Values of axes replace those
// of the file.
std::map<std::string, double, std::less<>> find_numbers(const Keys& keys,
                                                        const std::vector<Coordinate>& at) {
  std::map<std::string, double, std::less<>> numbers;
  auto add = [&](const std::string& key, const toml::node& node) {
    if (key.starts_with("model.")) return;  // model entries come from the model itself
    if (node.is_number())
      numbers[key] = *node.value<double>();
    else
      numbers.erase(key);
  };
  for (const auto& [key, node] : keys) add(key, *node);
  for (const auto& [axis, key, value] : at) add(key, *value);
  return numbers;
}

// Throws if a key is overridden that is also set by an axis, since the override would have no
// effect.
void check_not_shadowed(const Override& override, const std::vector<Coupled>& axes) {
  for (const auto& coupled : axes)
    for (const auto& axis : coupled)
      base::require(axis.key != override.key, "--set " + override.text(),
                    "found {}, which is an axis of [sweep], expected --set 'sweep.{}=[...]'",
                    axis.key, fmt::join(coupled | std::views::transform(&Axis::name), ", "));
}

}  // namespace

Node make_node(const base::Scalar& value) {
  if (const auto* flag = std::get_if<bool>(&value))
    return std::make_shared<toml::value<bool>>(*flag);
  if (const auto* whole = std::get_if<std::int64_t>(&value))
    return std::make_shared<toml::value<std::int64_t>>(*whole);
  if (const auto* number = std::get_if<double>(&value))
    return std::make_shared<toml::value<double>>(*number);
  if (const auto* text = std::get_if<std::string>(&value))
    return std::make_shared<toml::value<std::string>>(*text);
  const auto list = std::make_shared<toml::array>();
  for (const auto& text : std::get<std::vector<std::string>>(value)) list->push_back(text);
  return list;
}

std::string Override::text() const {
  return spelled.empty() ? fmt::format("{}={}", key, to_toml(*value)) : spelled;
}

Override parse_override(const std::string& text) {
  const auto equals = text.find('=');
  base::require(equals != std::string::npos && equals > 0, "--set " + text,
                "expected key.path=value");
  base::require(base::is_utf8(text), "--set " + text,
                "found bytes that are not UTF-8, expected UTF-8");
  const std::string key = text.substr(0, equals), value = text.substr(equals + 1);
  base::require(std::ranges::count(key, '.') < base::MAX_KEY_PARTS, "--set " + text,
                "found a key of more than {0} parts, expected at most {0}", base::MAX_KEY_PARTS);
  const auto parsed = std::make_shared<toml::table>();
  try {
    *parsed = base::parse_toml("value = " + value, "--set " + text);
  } catch (const BadInput&) {
    parsed->insert("value", value);
  }
  base::require(parsed->size() == 1, "--set " + text, "expected one value after '='");
  return {key, Node(parsed, parsed->get("value")), text};
}

Keys list_keys(const std::shared_ptr<const toml::table>& file) {
  static constexpr std::array<std::string_view, 8> NOT_OF_A_POINT = {
      "sweep", "let", "check", "plot", "best", "baseline", "report", "uncertain"};
  Keys keys;
  for (auto&& [section, content] : *file) {
    const std::string name(section.str());
    if (std::ranges::find(NOT_OF_A_POINT, name) != NOT_OF_A_POINT.end()) continue;
    if (!content.is_table()) {
      keys[name] = Node(file, &content);
      continue;
    }
    for (auto&& [key, node] : *content.as_table()) {
      const auto dotted = fmt::format("{}.{}", name, key.str());
      if (name != "model" || !node.is_table()) {
        keys[dotted] = Node(file, &node);
        continue;
      }
      for (auto&& [entry, value] : *node.as_table())
        keys[fmt::format("{}.{}", dotted, entry.str())] = Node(file, &value);
    }
  }
  return keys;
}

std::map<std::string, std::string> spell_keys(const Keys& keys) {
  std::map<std::string, std::string> spelled;
  for (const auto& [key, node] : keys)
    if (key != "title" && key != "question") spelled[key] = to_toml(*node);
  return spelled;
}

ExperimentSource::ExperimentSource(const std::string& path)
    : path(path), folder(std::filesystem::path(path).parent_path().string()) {}

ExperimentFile load_experiment(const ExperimentSource& source, const Overrides& overrides,
                               bool is_reduced) {
  const auto& path = source.path;
  const auto text = source.text ? *source.text : base::read_text(path);
  for (const auto& name : {path, source.folder})
    base::require(base::is_utf8(name), name,
                  "found a name that is not UTF-8, expected UTF-8 for run.json");
  const auto content = std::make_shared<toml::table>(base::parse_toml(text, path));
  toml::table& file = *content;
  std::vector<std::string> order;
  add_names(order, file, path);
  take_reduced(file, is_reduced, path);
  add_names(order, file, path);
  for (const auto& override : overrides) {
    set_key(file, override.key, *override.value);
    add_names(order, file, path);
  }

  ExperimentFile experiment;
  experiment.path = path;
  experiment.folder = source.folder;
  experiment.content = content;
  const auto in_play = programs_in_play(file, read_axes(content, order, path), path);
  const auto list_sweep = [&] {
    experiment.sweep = read_axes(content, order, path);
    name_axes(experiment.sweep, in_play, path);
    experiment.keys = list_keys(content);
  };
  list_sweep();
  if (expand_repetitions(file, order, experiment, in_play)) list_sweep();
  for (const auto& override : overrides) check_not_shadowed(override, experiment.sweep);
  read_judgement(file, experiment);
  const auto points = count_points(experiment.sweep, path);
  for (std::size_t i = 0; i < points; ++i) {
    auto at = find_coordinates(experiment.sweep, i);
    auto settings = bind_settings(experiment, at, in_play);
    auto numbers = find_numbers(experiment.keys, at);
    experiment.points.push_back({std::move(at), std::move(settings), std::move(numbers)});
  }
  return experiment;
}

std::vector<std::string> files_of(const Experiment& experiment) {
  std::vector<std::string> files{experiment.topology.path, experiment.routes.path};
  for (const auto& p : experiment.program->parameters) {
    const auto value = p.get(experiment.params);
    if (const auto* source = std::get_if<base::Source>(&value)) files.push_back(source->path);
  }
  return files;
}

std::string name_of(const Point& point) {
  std::string name;
  for (const auto& at : point.at)
    name += fmt::format("{}{} = {}", name.empty() ? "" : ", ", at.axis, to_toml(*at.value));
  return name;
}

}  // namespace laboratory
