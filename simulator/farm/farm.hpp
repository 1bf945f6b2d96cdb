#pragma once
// The farm of the thesis's chapter 4: a ray tracer with increasing realism on a machine of
// transputers. The coordinator's processor has links to the ray database's, the display's and the
// first worker's; the workers form any topology, of which a spanning tree is used (figure 4.10).
#include <optional>

#include "renderer/preview/preview.hpp"
#include "simulator/farm/centre.hpp"
#include "simulator/farm/coordination.hpp"
#include "simulator/observe/watch.hpp"
#include "simulator/tracing/busy.hpp"
#include "simulator/tracing/pixel_order.hpp"
#include "topologies/graph/topology.hpp"

namespace farm {

using tracing::Role;

struct Params {
  renderer::Params image;  ///< size, shading and its limits
  std::vector<Limits> stages =
      std::vector<Limits>(1);  ///< the interactive phase's limits, one set after the other
  std::vector<Order> script;   ///< the user's orders; Begin and Quit are added
  int max_cell = 16;           ///< pixels, the largest image cell; a power of two
  CellOrder order = CellOrder::random;
  CellLight cells = CellLight::constant;
  tracing::PixelOrder pixels = tracing::PixelOrder::cells;  ///< else in place of cells and `order`
  /// Drawn by the display itself before the first ray (thesis, 4.1); none: it begins black.
  std::optional<renderer::PreviewStep> preview;
  Weights weights;             ///< of stages and orders that have none of their own
  growth::Looks looks;         ///< at the picture while it grows
  std::optional<Block> block;  ///< a task; without it a task is a ray
  std::uint64_t seed = 1;      ///< for the order of cells
  /// Bytes of a message when the scene is sent to the workers, all the way down the tree, and
  /// acknowledged before the first task; 0: they have it, as in the thesis's measurements.
  std::uint32_t scene_message = 0;
  std::optional<std::uint64_t> worker_memory, database_memory;  ///< bytes; else the model's
  /// Intersections, shading and what the display adds up are charged the host time they take, times
  /// this; else their counts. The ray database's operations are counted in any case.
  std::optional<double> cycles_per_host_s;
  bool profile = false;  ///< measure the host time spent in kernels
  /// Faults by number of worker, from 0. The farm finds no other way: it waits for what is cut off.
  std::vector<programs::PlannedFault> faults;
  programs::OtherModels others;  ///< by number of worker, from 0
  machine::EngineParams engine = {};
  observe::Watch* watch = nullptr;  ///< its limit and trace, if there is one
};

struct Result : tracing::Rendering {
  std::optional<double> reorder_pause_s;  ///< the longest while all rays were classified again
  double interactive_s = 0;               ///< the interactive phase's part of time_s
  RayStores::Lengths peaks;               ///< the most rays in the database's stores
  std::uint64_t tasks = 0;                ///< rays, or blocks
  std::size_t peak_tasks_in_farm = 0;
  double drain_s = 0;               ///< part of time_s after the last task was handed out
  topologies::Topology topology;    ///< the workers' topology, as wired
  double mean_depth = 0;            ///< links from the coordinator to a worker, on average
  machine::Cycles kernel_cycles{};  ///< charged for the workers' tasks
  double kernel_host_s = 0;         ///< with Params::profile
};

/// Throws base::BadInput naming the field, what was found and what was expected.
void check(const Params& params);

/// Throws base::BadInput for a topology whose root cannot be joined to the coordinator, and
/// machine::Fault.
Result run_farm(const machine::Model& model, const topologies::Topology& workers,
                const renderer::Scene& scene, const Params& params);

// The parts that farms of every kind have.

/// What a kernel of the coordinator or of the display costs.
kernels::KernelCost central_cost(const char* name, const machine::Model& model,
                                 const Params& params);
std::uint64_t worker_memory(const machine::Model& model, const Params& params);    ///< bytes
std::uint64_t database_memory(const machine::Model& model, const Params& params);  ///< bytes
/// Adds a processor and takes the program's part of its memory.
machine::Processor& add_processor(machine::Machine& machine, const std::string& name,
                                  std::uint64_t memory, const char* role,
                                  std::shared_ptr<const machine::Model> model = {});
/// Adds a worker's processor: it has its label, or else is called "workerN", N from 1 on.
machine::Processor& add_worker(machine::Machine& machine, const topologies::Topology& workers,
                               int id, const Params& params);
/// Takes the image's part of the display's memory.
void allocate_image(machine::Processor& display, const renderer::Params& image);
/// Says which link the topology of the workers has lost to the coordinator, if any.
std::vector<std::string> note_given_up(const topologies::Topology& asked,
                                       const topologies::Topology& wired);
/// What the coordination has measured of a run that has ended, or has been cut short.
Result make_result(Progress& progress, machine::End end);

}  // namespace farm
