#include "experiments/laboratory/file/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "experiments/laboratory/file/values.hpp"
#include "experiments/laboratory/table/samples.hpp"
#include "experiments/laboratory/table/table.hpp"

namespace laboratory {
namespace {

constexpr std::size_t MAX_POINTS = 100'000;

// Makes one flat table of axes. TOML reads unquoted axis names with dots as nested tables.
void flatten(toml::table& from, const std::string& prefix, toml::table& into) {
  for (auto&& [name, node] : from) {
    const auto dotted = prefix + std::string(name.str());
    if (auto* table = node.as_table())
      flatten(*table, dotted + ".", into);
    else
      node.visit([&](auto& value) {
        into.insert(join_names(dotted), std::move(value));
      });  // keeps the line number for error messages
  }
}

toml::table* flatten_sweep(toml::table& file, const std::string& origin) {
  auto* node = file.get("sweep");
  if (!node) return nullptr;
  base::require(node->is_table(), origin, "sweep: expected a section of axes");
  toml::table flat;
  flatten(*node->as_table(), "", flat);
  *node->as_table() = std::move(flat);
  return node->as_table();
}

// Spells a value. Equal numbers such as 2 and 2.0 have equal spellings.
std::string spell(const toml::node& value) {
  if (const auto* list = value.as_array()) {
    std::string text;
    for (const auto& entry : *list) text += spell(entry) + ",";
    return text;
  }
  const bool is_number = value.is_number() && std::abs(*value.value<double>()) < 0x1p53;
  return is_number ? fmt::format("{}", *value.value<double>()) : to_toml(value);
}

// Reads the values of each axis from a list. For axes that change together, each element of the
// list is a list with one value for each axis. The values share ownership of `file`.
void read_values(Coupled& axes, const Place& at, const std::shared_ptr<const toml::table>& file) {
  const auto* list = at.node.as_array();
  if (!list || list->empty()) at.refuse("an array of values, at least one");
  std::set<std::string> known;
  for (const auto& entry : *list) {
    const auto* values = entry.as_array();
    if (axes.size() > 1 && (!values || values->size() != axes.size()))
      at.inside(at.key, entry)
          .refuse(fmt::format("an array of {} values, {}", axes.size(),
                              at.key.substr(at.key.find('.') + 1)));
    if (!known.insert(spell(entry)).second)
      at.refuse(fmt::format("each value only once: found {} twice", to_toml(entry)));
    for (std::size_t i = 0; i < axes.size(); ++i)
      axes[i].values.emplace_back(file, axes.size() > 1 ? values->get(i) : &entry);
  }
}

// The key of a seed, and the first value of the seed.
struct Seed {
  std::string key;
  std::int64_t first;
};

// Lists the seeds of the programs, without seeds that have no effect. Takes their values from the
// first point of the sweep.
std::vector<Seed> find_seed_keys(const Experiment& first, const Programs& in_play) {
  std::vector<Seed> seeds;
  for (const auto* program : in_play) {
    const auto& params = program == first.program ? first.params : program->defaults;
    for (const auto& p : program->parameters) {
      const auto key = programs::key_of(p);
      if (!is_seed(key.substr(key.rfind('.') + 1)) ||
          std::ranges::find(seeds, key, &Seed::key) != seeds.end() ||
          (program->voids && !program->voids(params, key).empty()))
        continue;
      const auto value = p.get(params);
      const auto* whole = std::get_if<std::int64_t>(&value);
      if (whole) seeds.push_back({key, *whole});
    }
  }
  return seeds;
}

}  // namespace

std::string join_names(std::string_view name) {
  return fmt::format("{}", fmt::join(split_names(name), ", "));
}

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

std::vector<Coupled> read_axes(const std::shared_ptr<const toml::table>& file,
                               const std::vector<std::string>& order, const std::string& origin) {
  std::vector<Coupled> all;
  const auto* sweep = (*file)["sweep"].as_table();
  if (!sweep) return all;
  for (const auto& names : order) {
    // [sweep] may lack a listed axis, since --set may have replaced the section
    if (!sweep->contains(names)) continue;
    Coupled& axes = all.emplace_back();
    for (const auto& name : split_names(names)) axes.push_back({name, {}, {}});
    read_values(axes, {origin, "sweep." + names, "", *sweep->get(names)}, file);
  }
  return all;
}

void name_axes(std::vector<Coupled>& axes, const Programs& in_play, const std::string& origin) {
  std::set<std::string> keys;
  for (auto& coupled : axes)
    for (auto& axis : coupled) {
      const auto named = name_axis(axis.name, in_play, origin);
      if (!keys.insert(named.key).second)
        Place{origin, "sweep." + axis.name, "", *axis.values[0]}.refuse(
            "each axis only once: found " + named.key + " again");
      axis.name = named.name;
      axis.key = named.key;
    }
}

bool expand_repetitions(toml::table& file, std::vector<std::string>& order,
                        const ExperimentFile& experiment, const Programs& in_play) {
  constexpr const char* KEY = "run.repetitions";
  const auto& axes = experiment.sweep;
  for (const auto& axis : axes | std::views::join)
    base::require(axis.key != KEY, experiment.path,
                  "sweep.{}: expected [run] repetitions = N, not an axis", axis.name);
  const auto* node = file["run"]["repetitions"].node();
  if (!node) return false;
  const auto where = Place{experiment.path, KEY, "", *node}.where() + ": " + KEY;
  const auto first = bind_settings(experiment, find_coordinates(axes, 0), in_play);
  file["run"].as_table()->erase("repetitions");
  if (first.repetitions == 1) return true;
  const auto seeds = find_seed_keys(first, in_play);
  base::require(!seeds.empty(), where,
                "the program {} has no seed, so that repetitions would be equal", in_play[0]->name);
  std::vector<std::string> names;
  for (const auto& seed : seeds) {
    for (const auto& axis : axes | std::views::join)
      base::require(axis.key != seed.key, where,
                    "found the axis {} in [sweep] too, expected either repetitions or this axis",
                    axis.name);
    names.push_back(seed.key);
  }
  toml::array values;
  for (std::int64_t i = 0; i < first.repetitions; ++i) {
    toml::array row;
    for (const auto& seed : seeds) row.push_back(seed.first + i);
    if (seeds.size() > 1)
      values.push_back(std::move(row));
    else
      values.push_back(seeds[0].first + i);
  }
  auto* sweep = file.insert("sweep", toml::table{}).first->second.as_table();
  const auto name = join_texts(names, ", ");
  sweep->insert_or_assign(name, std::move(values));
  order.push_back(name);
  return true;
}

std::vector<Coordinate> find_coordinates(const std::vector<Coupled>& axes, std::size_t point) {
  std::vector<Coordinate> at;
  for (const auto& coupled : std::views::reverse(axes)) {
    const auto count = coupled[0].values.size();
    for (const auto& axis : std::views::reverse(coupled))
      at.push_back({axis.name, axis.key, axis.values[point % count]});
    point /= count;
  }
  std::ranges::reverse(at);
  return at;
}

std::string resolve(const ExperimentFile& file) {
  if (!file.content->contains("sweep")) return to_toml(*file.content);
  toml::table rest = *file.content;
  rest.erase("sweep");
  const auto in_play = programs_in_play(*file.content, file.sweep, file.path);
  std::string text = to_toml(rest) + "\n\n[sweep]";
  const auto name_of = [&](const Axis& axis) {
    const bool is_short =
        !axis.key.starts_with("model.") && name_axis(axis.name, in_play, "").key == axis.key;
    return is_short ? axis.name : axis.key;
  };
  for (const auto& coupled : file.sweep) {
    if (coupled[0].values.empty()) continue;  // the axis that numbers the randomly drawn machines
    std::vector<std::string> names, entries;
    for (const auto& axis : coupled) names.push_back(name_of(axis));
    for (std::size_t i = 0; i < coupled[0].values.size(); ++i) {
      std::vector<std::string> values;
      for (const auto& axis : coupled) values.push_back(to_toml(*axis.values[i]));
      const auto entry = join_texts(values, ", ");
      entries.push_back(coupled.size() > 1 ? "[" + entry + "]" : entry);
    }
    const auto name = join_texts(names, ", ");
    const bool is_bare = name.find_first_of(".,") == std::string::npos;
    text +=
        fmt::format("\n{} = [{}]", is_bare ? name : "\"" + name + "\"", join_texts(entries, ", "));
  }
  return text;
}

std::size_t count_points(const std::vector<Coupled>& axes, const std::string& path) {
  double points = 1;
  for (const auto& coupled : axes) points *= static_cast<double>(coupled[0].values.size());
  base::require(points <= MAX_POINTS, path, "[sweep] spans {} points, expected at most {}",
                points < 1e15 ? fmt::format("{:.0f}", points) : fmt::format("{:.3g}", points),
                MAX_POINTS);
  return static_cast<std::size_t>(points);
}

}  // namespace laboratory
