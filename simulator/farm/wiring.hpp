#pragma once
// Placement of the farm's processes and the channels between them (figures 4.10, 4.11).
#include <deque>
#include <vector>

#include "simulator/farm/messages.hpp"
#include "topologies/graph/topology.hpp"

namespace farm {

struct Kernel;
struct Params;

/// The farm's channels by message type. Deques keep references valid.
struct Wires {
  std::deque<Channel<Signal>> signals;
  std::deque<Channel<Task>> tasks;
  std::deque<Channel<Answer>> results;
};

/// One way out of a data router: its sender signals that it is free, then takes a message.
struct Way {
  Channel<Signal>& free;
  Channel<Task>& into;
};

/// Starts a sender that feeds `destination`.
Way start_sender(Wires& wires, machine::Processor& on, Channel<Task>& destination);

/// Worker processors joined by the topology, and the channels along its spanning tree.
struct Workers {
  topologies::Topology topology;  ///< as wired
  std::size_t root = 0;
  double mean_depth = 0;  ///< links from the coordinator to a worker, on average
  std::vector<machine::Processor*> processors;
  std::vector<std::vector<int>> children;
  std::vector<Channel<Task>*> from_left;  ///< tasks into each worker
  std::vector<Channel<Answer>*> results;  ///< out of each worker
};

/// Frees a port at the root for the coordinator. A root with four links (a torus) gives up one of
/// several links to one neighbour, else the link on its highest port that is not a bridge. Throws
/// base::BadInput if there is none.
topologies::Topology free_root_port(topologies::Topology topology);

/// Adds and joins the workers' processors, each with its program loaded. The coordinator's link
/// uses the root's free port.
Workers wire_workers(Wires& wires, machine::Machine& machine, const topologies::Topology& topology,
                     machine::Processor& coordinator, const Params& params);

/// Starts the processes of worker `id`.
void start_worker(Wires& wires, const Workers& workers, std::size_t id, Kernel& kernel);

}  // namespace farm
