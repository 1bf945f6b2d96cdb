#include "experiments/laboratory/points/pattern_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <ctime>
#include <set>

#include "base/errors.hpp"
#include "experiments/laboratory/file/program.hpp"
#include "experiments/laboratory/points/farm_run.hpp"
#include "experiments/laboratory/points/machine_model.hpp"
#include "experiments/laboratory/points/network_setup.hpp"
#include "experiments/laboratory/points/pattern_images.hpp"
#include "simulator/machine/faults.hpp"
#include "topologies/make/generators.hpp"

namespace laboratory {

using nlohmann::ordered_json;

namespace {

programs::Setup make_setup_without_network(const Experiment& experiment,
                                           const programs::Pattern& pattern,
                                           const machine::Model& model) {
  programs::Setup setup{model, topologies::make_line(1), experiment.parameters, nullptr, &pattern};
  setup.files = experiment.files;
  setup.cycles_per_host_s = experiment.farm.cycles_per_host_s;
  return setup;
}

programs::Setup make_setup(const Experiment& experiment, const programs::Pattern& pattern,
                           const machine::Model& model, observe::Watch& watch) {
  auto setup = make_setup_without_network(experiment, pattern, model);
  setup.watch = &watch;
  if (pattern.uses_topology) setup.topology = make_workers(experiment);
  if (pattern.uses_routes) {
    setup.routes = find_routes(experiment, setup.topology);
    setup.tree = find_tree(experiment, setup.topology);
  }
  setup.faults = find_faults(experiment, setup.topology);
  return setup;
}

// A processor is called by its label, where the topology has labels.
ordered_json to_json(const programs::Row& row, const topologies::Topology& topology,
                     std::string& ended) {
  ordered_json json = ordered_json::object();
  for (const auto& [name, value] : row) {
    if (name == "processor" && !topology.labels.empty())
      json[name] = topology.labels.at(static_cast<std::size_t>(value));
    else
      json[name] = std::isfinite(value) ? ordered_json(value) : ordered_json();
    if (name == "saturated" && value != 0) ended = "saturated";
  }
  return json;
}

// One row without parts; with them any number, each of its own.
void check_rows(const programs::Pattern& pattern, const std::vector<ordered_json>& rows) {
  if (pattern.parts.empty()) return base::check_equal("rows of a point", rows.size(), 1u);
  std::set<std::string> known;
  for (const auto& row : rows) {
    std::string key;
    bool missing = false;
    for (const auto& part : pattern.parts) {
      const auto value = row.value(part, ordered_json());
      missing |= value.is_null();
      key += value.dump() + " ";
    }
    if (missing || !known.insert(key).second)
      throw base::InvariantBroken(
          fmt::format("the program {} has two rows of, or one without, {} {}", pattern.name,
                      fmt::join(pattern.parts, ", "), key));
  }
  if (rows.empty())
    throw base::InvariantBroken(fmt::format("the program {} has no row", pattern.name));
}

}  // namespace

void check_pattern_point(const Experiment& experiment) {
  check_files(experiment);
  const auto& pattern = *find_pattern(experiment.program);
  if (!pattern.check) return;
  const auto model = make_model(experiment);
  pattern.check(make_setup_without_network(experiment, pattern, model));
}

ordered_json run_pattern_point(const Experiment& experiment, const std::filesystem::path& images,
                               observe::Watch& watch) {
  const auto start = std::clock();
  const auto& pattern = *find_pattern(experiment.program);
  const auto model = make_model(experiment);
  const auto setup = make_setup(experiment, pattern, model, watch);
  ordered_json result = ordered_json::object();
  if (pattern.uses_topology) {
    result["topology"] = setup.topology.name;
    result["processors"] = setup.topology.processors;
  }
  std::string ended = "done";
  std::vector<ordered_json> rows;
  std::vector<std::string> notes;
  try {
    auto found = pattern.run(setup);
    for (const auto& row : found.rows) rows.push_back(to_json(row, setup.topology, ended));
    notes = std::move(found.notes);
    check_rows(pattern, rows);
    if (!found.images.empty()) result["images"] = save_images(found.images, images);
  } catch (const programs::Unfinished&) {
    ended = machine::to_string(watch.end);
  }
  result["ended"] = ended;
  if (rows.empty())
    result["row"] = ordered_json::object();
  else if (pattern.parts.empty())
    result["row"] = std::move(rows[0]);
  else
    result["rows"] = std::move(rows);
  if (!notes.empty()) result["notes"] = std::move(notes);
  result["host"] = {{"total_s", static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC}};
  return result;
}

}  // namespace laboratory
