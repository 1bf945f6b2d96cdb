#pragma once
// The farm of the thesis's chapter 4: a ray tracer with increasing realism on transputers. The
// coordinator has links to the ray database, the display and the first worker. The workers form any
// topology; tasks follow its spanning tree (figure 4.10).
#include <optional>

#include "renderer/preview/preview.hpp"
#include "simulator/farm/centre.hpp"
#include "simulator/farm/coordination.hpp"
#include "simulator/observe/run_monitor.hpp"
#include "simulator/ray_tracing/busy.hpp"
#include "simulator/ray_tracing/pixel_order.hpp"
#include "topologies/graph/topology.hpp"

namespace farm {

using ray_tracing::Role;

struct Params {
  renderer::Params image;  ///< size, shading and its limits
  std::vector<Limits> stages =
      std::vector<Limits>(1);  ///< limits of the interactive phase, applied one after another
  std::vector<Order> script;   ///< the user's orders; the program adds Begin and Quit
  int max_cell = 16;           ///< side of the largest image cell, pixels; a power of two
  CellOrder order = CellOrder::random;
  CellLight cells = CellLight::constant;
  ray_tracing::PixelOrder pixels =
      ray_tracing::PixelOrder::cells;  ///< others replace cells, `order`
  /// Picture that the display draws itself before the first ray (thesis, 4.1); none: black.
  std::optional<renderer::PreviewStep> preview;
  Weights weights;                     ///< for stages and orders without weights of their own
  snapshots::Schedule snapshot_times;  ///< times at which the growing picture is recorded
  std::optional<Block> block;          ///< size of a task; none: a task is a ray
  std::uint64_t seed = 1;              ///< seed of the order of cells
  /// Longest message (bytes) of the scene on its way down the tree; workers acknowledge it before
  /// the first task. 0: workers have the scene, as in the thesis's measurements.
  std::uint32_t scene_message = 0;
  std::optional<std::uint64_t> worker_memory, database_memory;  ///< bytes; else the model's
  /// If set, charges intersections, shading and display by host time, with this factor; else by
  /// operation counts. The ray database is always charged by counts.
  std::optional<double> cycles_per_host_s;
  bool profile = false;  ///< measure the host time spent in kernels
  /// Faults by worker number, from 0. The farm does not reroute: it waits for lost workers forever.
  std::vector<programs::PlannedFault> faults;
  programs::OtherModels others;  ///< by worker number, from 0
  machine::EngineParams engine = {};
  observe::RunMonitor* monitor = nullptr;  ///< supplies limit and trace; may be null
};

struct Result : ray_tracing::Rendering {
  std::optional<double> reorder_pause_s;  ///< longest time to reclassify all rays
  double interactive_s = 0;               ///< part of time_s in the interactive phase
  RayStores::Lengths peaks;               ///< most rays in each store of the database
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

/// Throws base::BadInput if the root cannot be joined to the coordinator; throws machine::Fault.
Result run_farm(const machine::Model& model, const topologies::Topology& workers,
                const renderer::Scene& scene, const Params& params);

// Parts shared by all kinds of farm.

/// Cost of a kernel of the coordinator or of the display.
kernels::KernelCost central_cost(const char* name, const machine::Model& model,
                                 const Params& params);
std::uint64_t worker_memory(const machine::Model& model, const Params& params);    ///< bytes
std::uint64_t database_memory(const machine::Model& model, const Params& params);  ///< bytes
/// Adds a processor and allocates the program in its memory.
machine::Processor& add_processor(machine::Machine& machine, const std::string& name,
                                  std::uint64_t memory, const char* role,
                                  std::shared_ptr<const machine::Model> model = {});
/// Adds a worker's processor, named by its label or else "workerN", N from 1.
machine::Processor& add_worker(machine::Machine& machine, const topologies::Topology& workers,
                               int id, const Params& params);
/// Allocates the image in the display's memory.
void allocate_image(machine::Processor& display, const renderer::Params& image);
/// Notes the link that the workers' topology gave up for the coordinator, if any.
std::vector<std::string> note_given_up(const topologies::Topology& asked,
                                       const topologies::Topology& wired);
/// Measurements of the coordination, after the run's end or after it was cut short.
Result make_result(Progress& progress, machine::End end);

}  // namespace farm
