#pragma once
// Builds the parts of a point from [machine], [model], [network], [[processor]] and [[fault]]. All
// functions throw BadInput with the key for unknown names and files.
#include <optional>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "simulator/machine/model.hpp"
#include "topologies/route/routes.hpp"

namespace laboratory {

machine::Model make_model(const ModelSpec& spec);
/// Identifies a model: its name and its changed entries.
std::string model_key(const ModelSpec& spec);
/// Calls back with the model of the machine, then with those of [[processor]].
void for_each_model(const Experiment& experiment, auto visit) {
  visit(experiment.model);
  for (const auto& other : experiment.others) visit(other.model);
}
/// The models of all points, each once, in the order of the points.
std::vector<machine::Model> models_of(const ExperimentFile& file);

/// The network of a point: "tree" and 7 workers is tree:7, "mesh" and 12 the most square mesh of
/// 12.
topologies::Topology make_workers(const Experiment& experiment);
/// True if the topology defines its own size, so that `workers` is ignored.
bool has_own_workers(const Experiment& experiment);

/// The shortest routes, or those of network.routes.
topologies::RoutingTable find_routes(const Experiment& experiment,
                                     const topologies::Topology& topology);
/// The single tree for broadcasts; none if each sender has its own.
std::optional<topologies::TreeLinks> find_tree(const Experiment& experiment,
                                               const topologies::Topology& topology);
/// The processors with other models than the machine's `model`.
programs::OtherModels find_others(const Experiment& experiment,
                                  const topologies::Topology& topology,
                                  const machine::Model& model);
/// The faults in the order of the file.
std::vector<programs::PlannedFault> find_faults(const Experiment& experiment,
                                                const topologies::Topology& topology);

/// Throws as these functions and make_workers do.
void check_network(const Experiment& experiment);
/// The settings that determine a network: points with equal keys have equal networks.
std::string network_key(const Experiment& experiment);

}  // namespace laboratory
