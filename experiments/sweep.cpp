#include "experiments/sweep.hpp"

#include <algorithm>
#include <set>
#include <tuple>

#include "experiments/program.hpp"
#include "experiments/values.hpp"
#include "simulator/machine/faults.hpp"

namespace experiments {

namespace {

using machine::InvalidInput;

constexpr std::size_t MAX_POINTS = 100'000;

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

std::size_t count_points(const std::vector<Coupled>& axes, const std::string& path) {
  std::size_t points = 1;
  for (const auto& coupled : axes) {
    points *= coupled[0].values.size();
    if (points > MAX_POINTS)
      throw InvalidInput(fmt::format("{}: [sweep] spans more than {} points", path, MAX_POINTS));
  }
  return points;
}

}  // namespace experiments
