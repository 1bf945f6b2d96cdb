#pragma once
// Placement of the farm's processes and the channels between them (figures 4.10, 4.11).
#include <deque>
#include <vector>

#include "simulator/farm/messages.hpp"
#include "simulator/programs/declare/program.hpp"
#include "topologies/graph/topology.hpp"

namespace farm {

struct Kernel;
struct Params;

/// The farm's channels by message type, in deques so that references stay valid.
struct Wires {
  std::deque<Channel<Signal>> signals;
  std::deque<Channel<Task>> tasks;
  std::deque<Channel<Answer>> results;
};

/// A way out of a data router. The way's sender process signals that it is free, then takes a
/// message.
struct Way {
  Channel<Signal>& free;
  Channel<Task>& into;
};

/// Starts a sender process for `destination`.
Way start_sender(Wires& wires, machine::Processor& on, Channel<Task>& destination);

/// The workers' processors, joined by the topology, and the channels along its spanning tree.
struct Workers {
  topologies::Topology topology;  ///< the topology as wired
  std::size_t root = 0;
  double mean_depth = 0;  ///< mean distance from the coordinator in links
  std::vector<machine::Processor*> processors;
  std::vector<std::vector<int>> children;
  std::vector<Channel<Task>*> from_left;  ///< tasks into each worker, by worker
  std::vector<Channel<Answer>*> results;  ///< results out of each worker, by worker
};

/// Frees a port of the root for the coordinator. If the root has four links (as in a torus),
/// removes one. Prefers a link parallel to another, then the one on the highest port that is not a
/// bridge. Throws base::BadInput if all links are bridges.
topologies::Topology free_root_port(topologies::Topology topology);

/// Adds and links the workers' processors and loads their programs. The coordinator is linked to
/// the root's free port.
Workers wire_workers(Wires& wires, machine::Machine& machine, machine::Processor& coordinator,
                     const programs::Setup& setup, const Params& params);

/// Starts the processes of worker `id`.
void start_worker(Wires& wires, const Workers& workers, std::size_t id, Kernel& kernel);

}  // namespace farm
