#pragma once
// Placement of the farm's processes and the channels between them (thesis, figures 4.10 and 4.11).
#include <deque>
#include <vector>

#include "simulator/farm/messages.hpp"
#include "simulator/programs/declare/program.hpp"
#include "topologies/graph/topology.hpp"

namespace farm {

struct Kernel;
struct Params;

/// The farm's channels by message type. They are in deques so that references to them stay valid.
struct Wires {
  std::deque<Channel<Signal>> signals;
  std::deque<Channel<Task>> tasks;
  std::deque<Channel<Answer>> results;
};

/// Connection to a sender process. The sender signals on `free` that it can take a task, and then
/// takes the task from `into`.
struct Way {
  Channel<Signal>& free;
  Channel<Task>& into;
};

/// Starts a sender process on `on`, which forwards tasks to `destination`.
Way start_sender(Wires& wires, machine::Processor& on, Channel<Task>& destination);

/// The workers' processors, joined by the topology, and the channels along the topology's spanning
/// tree.
struct Workers {
  /// The topology without the link that was removed for the coordinator.
  topologies::Topology topology;
  std::size_t root = 0;
  double mean_depth = 0;  ///< mean distance from the coordinator in links
  std::vector<machine::Processor*> processors;
  std::vector<std::vector<int>> children;
  std::vector<Channel<Task>*> from_left;  ///< tasks into each worker, by worker
  std::vector<Channel<Answer>*> results;  ///< results out of each worker, by worker
};

/// Frees a port of the root for the coordinator. If all four links of the root are used (as in a
/// torus), removes one of them: preferably one with a parallel link, otherwise the one on the
/// highest port that is not a bridge (the only connection between two parts). Throws base::BadInput
/// if all links are bridges.
topologies::Topology free_root_port(topologies::Topology topology);

/// Adds the workers' processors and their links, and loads their programs. Links the coordinator to
/// the root's free port.
Workers wire_workers(Wires& wires, machine::Machine& machine, machine::Processor& coordinator,
                     const programs::Setup& setup, const Params& params);

/// Starts the processes of worker `id`.
void start_worker(Wires& wires, const Workers& workers, std::size_t id, Kernel& kernel);

}  // namespace farm
