#pragma once
// What [machine], [model], [network], [[processor]] and [[fault]] mean at a point. All throw
// BadInput for what is not there, with the key.
#include <optional>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "simulator/machine/model.hpp"
#include "topologies/route/routes.hpp"

namespace laboratory {

machine::Model make_model(const ModelSpec& spec);
/// What tells a model from others: its name, and what has been changed.
std::string model_key(const ModelSpec& spec);
/// Calls back with the model of the machine, then with those of [[processor]].
void for_each_model(const Experiment& experiment, auto visit) {
  visit(experiment.model);
  for (const auto& other : experiment.others) visit(other.model);
}
/// The models that some point runs on, each once, in the order of the points.
std::vector<machine::Model> models_of(const ExperimentFile& file);

/// The network of a point: "tree" and 7 workers is tree:7, "mesh" and 12 the most square mesh
/// of 12.
topologies::Topology make_workers(const Experiment& experiment);
/// Whether the topology says its size itself, so that `workers` is void.
bool has_own_workers(const Experiment& experiment);

/// The shortest routes, or those that network.routes names.
topologies::RoutingTable find_routes(const Experiment& experiment,
                                     const topologies::Topology& topology);
/// The single tree of messages to all; none where each sender has its own.
std::optional<topologies::TreeLinks> find_tree(const Experiment& experiment,
                                               const topologies::Topology& topology);
/// The processors of other models than the machine's, which is `model`.
programs::OtherModels find_others(const Experiment& experiment,
                                  const topologies::Topology& topology,
                                  const machine::Model& model);
/// The faults in the order of the file.
std::vector<programs::PlannedFault> find_faults(const Experiment& experiment,
                                                const topologies::Topology& topology);

/// Throws as these and as make_workers do.
void check_network(const Experiment& experiment);
/// What they depend on: points of equal keys have equal networks.
std::string network_key(const Experiment& experiment);

}  // namespace laboratory
