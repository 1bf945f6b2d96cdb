#pragma once
// Construction of the parts of a point from [machine], [model], [network], [[processor]] and
// [[fault]]. All functions throw BadInput with the key for unknown names and files.
#include <optional>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "simulator/machine/model.hpp"
#include "topologies/route/routes.hpp"

namespace laboratory {

machine::Model make_model(const ModelSpec& spec);
/// The key of a model: its name and its overridden entries.
std::string model_key(const ModelSpec& spec);
/// Visits the model of the machine, then those of [[processor]].
void for_each_model(const Experiment& experiment, auto visit) {
  visit(experiment.model);
  for (const auto& other : experiment.others) visit(other.model);
}
/// The models of all points, each once, in the order of the points.
std::vector<machine::Model> models_of(const ExperimentFile& file);

/// Makes the network of a point. "tree" with 7 workers becomes tree:7; "mesh" with 12 becomes the
/// most square mesh of 12.
topologies::Topology make_workers(const Experiment& experiment);
/// True if the topology defines its own size, so that `workers` has no effect.
bool has_own_workers(const Experiment& experiment);

/// Makes the routes: shortest ones, or those of network.routes.
topologies::RoutingTable find_routes(const Experiment& experiment,
                                     const topologies::Topology& topology);
/// Makes the single tree for broadcasts; none if each sender has its own.
std::optional<topologies::TreeLinks> find_tree(const Experiment& experiment,
                                               const topologies::Topology& topology);
/// Loads the models of processors that differ from the machine's `model`.
programs::OtherModels find_others(const Experiment& experiment,
                                  const topologies::Topology& topology,
                                  const machine::Model& model);
/// Finds the parts of the network that the file's faults affect, in the order of the file.
std::vector<programs::PlannedFault> find_faults(const Experiment& experiment,
                                                const topologies::Topology& topology);

/// Makes the network, routes, tree and faults of a point, and throws what these functions throw.
void check_network(const Experiment& experiment);
/// The key of a network, made of its settings. Points with equal keys have equal networks.
std::string network_key(const Experiment& experiment);

}  // namespace laboratory
