#pragma once
// Makes the parts of a point's machine from [machine], [model], [network], [[processor]] and
// [[fault]]. All functions throw BadInput with the key for unknown names and files.
#include <optional>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "simulator/machine/model.hpp"
#include "topologies/route/routes.hpp"

namespace laboratory {

machine::Model make_model(const ModelSpec& spec);
/// The key of a model: its name with its overridden entries. Equal keys mean equal models.
std::string model_key(const ModelSpec& spec);
/// Calls `visit` for the model of the machine, then for those of [[processor]].
void for_each_model(const Experiment& experiment, auto visit) {
  visit(experiment.model);
  for (const auto& other : experiment.others) visit(other.model);
}
/// The models of all points, each once, in the order of the points.
std::vector<machine::Model> models_of(const ExperimentFile& file);

/// Makes the network of a point. The topology "tree" with 7 workers becomes tree:7; "mesh" with 12
/// workers becomes the 12-processor mesh that is closest to a square.
topologies::Topology make_workers(const Experiment& experiment);
/// True if the topology defines its own size, so that `workers` has no effect.
bool has_own_workers(const Experiment& experiment);

/// Makes the routes: shortest ones, or those of network.routes.
topologies::RoutingTable find_routes(const Experiment& experiment,
                                     const topologies::Topology& topology);
/// Makes the single broadcast tree; no value if each sender has a tree of its own.
std::optional<topologies::TreeLinks> find_tree(const Experiment& experiment,
                                               const topologies::Topology& topology);
/// Loads the models of processors whose model is not `model`, the model of the machine.
programs::OtherModels find_others(const Experiment& experiment,
                                  const topologies::Topology& topology,
                                  const machine::Model& model);
/// Finds the links and processors that the faults affect, in the order of the file.
std::vector<programs::PlannedFault> find_faults(const Experiment& experiment,
                                                const topologies::Topology& topology);

/// Makes network, routes, tree and faults of a point, and drops them, because only their exceptions
/// matter.
void check_network(const Experiment& experiment);
/// The key of a network, made from its settings. Points with equal keys have equal networks.
std::string network_key(const Experiment& experiment);

}  // namespace laboratory
