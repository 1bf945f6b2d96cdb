#include "experiments/laboratory/setup/setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/errors.hpp"
#include "topologies/make/generators.hpp"
#include "topologies/route/given_routes.hpp"

namespace laboratory {

using base::require;
using topologies::Topology;

namespace {

Topology make_network(const Experiment& experiment) {
  const std::string& name = experiment.topology.path;
  const auto n = experiment.workers + (experiment.program ? experiment.program->services : 0);
  if (has_own_workers(experiment)) return topologies::make_topology(name);
  if (name == "mesh" || name == "torus") {
    auto rows = static_cast<std::int64_t>(std::sqrt(static_cast<double>(n)));
    while (n % rows != 0) --rows;
    return topologies::make_topology(fmt::format("{}:{}x{}", name, rows, n / rows));
  }
  if (name == "hypercube") {
    int dimensions = 0;
    while ((std::int64_t{1} << dimensions) < n) ++dimensions;
    require((std::int64_t{1} << dimensions) == n && dimensions <= topologies::PORTS,
            "network.workers",
            "found {}, expected 1, 2, 4, 8 or 16 for a hypercube (a larger one needs more than "
            "four links per processor)",
            n);
    return topologies::make_topology(fmt::format("hypercube:{}", dimensions));
  }
  // A ring of one or two processors is a line.
  if (name == "ring" && n < 3) return topologies::make_topology(fmt::format("line:{}", n));
  auto topology = topologies::make_topology(fmt::format("{}:{}", name, n));
  require(topology.processors == n, "network.workers",
          "found {}, but {} has {} processors, expected its size in network.topology",
          experiment.workers, topology.name, topology.processors);
  return topology;
}

}  // namespace

// Keeps the last model for the next call, since loading a model takes about ten milliseconds, as
// long as a short simulation. Does not keep models from files, which may change.
machine::Model make_model(const ModelSpec& spec) {
  thread_local std::string known;
  thread_local machine::Model last;
  const auto key = model_key(spec);
  if (key == known) return last;
  auto model = spec.entries.empty()
                   ? machine::load_model(spec.source.path)
                   : machine::override_model(spec.source.path, spec.entries, "[model]");
  if (!spec.source.path.ends_with(".toml")) {
    last = model;
    known = key;
  }
  return model;
}

std::string model_key(const ModelSpec& spec) {
  std::string key = spec.source.path;
  for (const auto& [entry, value] : spec.entries)
    key += fmt::format("\n{} = {}", entry, machine::to_text(value));
  return key;
}

std::vector<machine::Model> models_of(const ExperimentFile& file) {
  std::set<std::string> known;
  std::vector<machine::Model> models;
  for (const auto& point : file.points)
    for_each_model(point.experiment, [&](const ModelSpec& spec) {
      if (known.insert(model_key(spec)).second) models.push_back(make_model(spec));
    });
  return models;
}

Topology make_workers(const Experiment& experiment) {
  auto topology = make_network(experiment);
  std::set<std::pair<int, int>> links;
  for (const auto& link : topology.links) links.emplace(link.a.processor, link.b.processor);
  if (experiment.switches > 0)
    for (const auto& link : links) topology.switches[link] = experiment.switches;
  for (const auto& [a, b, count] : experiment.switches_between) {
    require(links.contains(std::minmax(a, b)), "network.switches",
            "found [{}, {}, {}], expected a link of {}: it has none from {} to {}", a, b, count,
            topology.name, describe_processor(topology, a), describe_processor(topology, b));
    topology.switches[std::minmax(a, b)] = count;
  }
  return topology;
}

bool has_own_workers(const Experiment& experiment) {
  return experiment.topology.path.find_first_of(":./") != std::string::npos;
}

topologies::RoutingTable find_routes(const Experiment& experiment, const Topology& topology) {
  return topologies::find_routes(topology, experiment.routes.path);
}

std::optional<topologies::TreeLinks> find_tree(const Experiment& experiment,
                                               const Topology& topology) {
  constexpr const char* KEY = "network.tree_links";
  const auto& links = experiment.tree_links;
  require(experiment.tree != "per_root" || links.empty(), KEY,
          "found links with network.tree = \"per_root\", expected network.tree = \"single\"");
  if (links.empty())
    return experiment.tree == "single" ? std::optional(make_tree_links(topology)) : std::nullopt;
  for (const auto& [a, b] : links)
    require(std::max(a, b) < topology.processors, KEY,
            "found [{}, {}], expected processors from 0 to {}", a, b, topology.processors - 1);
  return base::at_place(KEY, [&] { return check_tree_links(topology, links); });
}

programs::OtherModels find_others(const Experiment& experiment, const Topology& topology,
                                  const machine::Model& model) {
  programs::OtherModels others;
  std::map<std::string, std::shared_ptr<const machine::Model>> known;
  for (const auto& [number, spec, place] : experiment.others) {
    require(number < topology.processors, place + ": number",
            "found {}, expected processors from 0 to {}", number, topology.processors - 1);
    auto& its = known[model_key(spec)];
    if (!its)
      its = base::at_place(place + ": model", [&, &spec = spec] {
        return std::make_shared<const machine::Model>(make_model(spec));
      });
    require(its->link.bit_rate == model.link.bit_rate, place + ": model",
            "found {}, whose links run at {} bit/s, expected {} as those of {}", its->name,
            its->link.bit_rate, model.link.bit_rate, model.name);
    require(others.emplace(number, its).second, place + ": number",
            "found {} twice, expected each processor at most once", number);
  }
  return others;
}

std::vector<programs::PlannedFault> find_faults(const Experiment& experiment,
                                                const Topology& topology) {
  std::vector<programs::PlannedFault> faults;
  for (const auto& [fault, place] : experiment.faults) {
    const auto [low, high] = std::minmax(fault.a, fault.b);
    require(high < topology.processors, place, "found {}, expected processors from 0 to {}", high,
            topology.processors - 1);
    const bool is_there = std::ranges::any_of(topology.links, [&](const auto& link) {
      return link.a.processor == low && link.b.processor == high;
    });
    require(fault.b < 0 || is_there, place,
            "found link = [{}, {}], expected a link of {}: it has none from {} to {}", fault.a,
            fault.b, topology.name, describe_processor(topology, fault.a),
            describe_processor(topology, fault.b));
    faults.push_back(fault);
  }
  return faults;
}

void check_network(const Experiment& experiment) {
  const auto topology = make_workers(experiment);
  if (!experiment.routes.path.empty()) find_routes(experiment, topology);
  find_tree(experiment, topology);
  find_faults(experiment, topology);
  find_others(experiment, topology, make_model(experiment.model));
}

std::string network_key(const Experiment& e) {
  auto key =
      fmt::format("{} {} {} {} {}", e.topology.path, e.workers, e.switches, e.routes.path, e.tree);
  for (const auto& [a, b, count] : e.switches_between) key += fmt::format(" {} {} {}", a, b, count);
  for (const auto& [a, b] : e.tree_links) key += fmt::format(" tree {} {}", a, b);
  for (const auto& [fault, place] : e.faults) key += fmt::format(" fault {} {}", fault.a, fault.b);
  for (const auto& other : e.others)
    key += fmt::format(" processor {} {}", other.number, model_key(other.model));
  if (!e.others.empty()) key += model_key(e.model);
  return key;
}

}  // namespace laboratory
