#pragma once
// The farm of the thesis's chapter 4: a ray tracer with increasing realism on transputers. The
// coordinator is linked to the ray database, the display and the first worker. The workers form an
// arbitrary topology, and tasks follow its spanning tree (figure 4.10).
#include <optional>

#include "renderer/preview/preview.hpp"
#include "simulator/farm/centre.hpp"
#include "simulator/farm/coordination.hpp"
#include "simulator/observe/run_monitor.hpp"
#include "simulator/ray_tracing/busy.hpp"
#include "simulator/ray_tracing/pixel_order.hpp"
#include "topologies/graph/topology.hpp"

namespace farm {

using programs::Setup;
using ray_tracing::Role;

struct Params {
  renderer::Params image;  ///< size, shading and shading limits
  std::vector<Limits> stages =
      std::vector<Limits>(1);  ///< successive limits of the interactive phase
  std::vector<Order> script;   ///< the user's orders; the program adds Begin and Leave
  int max_cell = 16;           ///< side of the largest image cell in pixels, a power of two
  CellOrder order = CellOrder::random;
  CellLight cells = CellLight::constant;
  /// If not `cells`, this order of single pixels replaces `max_cell` and `order`.
  ray_tracing::PixelOrder pixels = ray_tracing::PixelOrder::cells;
  /// A picture drawn by the display before the first ray (thesis, 4.1). Without it the display is
  /// black.
  std::optional<renderer::PreviewStep> preview;
  Weights weights;                     ///< default for stages and orders without weights
  snapshots::Schedule snapshot_times;  ///< times at which the growing picture is recorded
  std::optional<Block> block;          ///< size of a task; if absent, each task is a ray
  std::uint64_t seed = 1;              ///< seed of the order of cells
  /// Maximum length in bytes of the messages that carry the scene down the tree before the first
  /// task. Workers acknowledge the last one. 0 means that workers already have the scene, as in the
  /// thesis's measurements.
  std::uint32_t scene_message = 0;
  std::optional<std::uint64_t> worker_memory, database_memory;  ///< in bytes; default: the model's
};

struct Result : ray_tracing::Rendering {
  std::optional<double> reorder_pause_s;  ///< maximum time for reclassifying all rays
  double interactive_s = 0;               ///< duration of the interactive phase, part of time_s
  RayStores::Lengths peaks;               ///< maximum number of rays in each store of the database
  std::uint64_t tasks = 0;                ///< number of tasks, which are rays or blocks
  std::size_t peak_tasks_in_farm = 0;
  double drain_s = 0;               ///< part of time_s after the last task was sent to a worker
  topologies::Topology topology;    ///< the workers' topology as wired
  double mean_depth = 0;            ///< mean distance of workers from the coordinator, in links
  machine::Cycles kernel_cycles{};  ///< cycles charged for the workers' tasks
  double kernel_host_s = 0;         ///< measured only with Setup::profile
};

/// Throws base::BadInput that names the field, the value found and the values expected.
void check(const Params& params);

/// Runs the farm; `setup.topology` joins the workers. The ray database is always charged by counts.
/// The farm does not reroute messages after a fault: it waits for lost workers for ever. Throws
/// base::BadInput if the root has no port for the coordinator, and machine::Fault.
Result run_farm(const Setup& setup, const renderer::Scene& scene, const Params& params);

// Parts shared by both kinds of farm.

/// `charged` returns the cycles charged for the workers' tasks.
Visualisation make_visualisation(const Setup& setup, const renderer::Scene& scene,
                                 const Params& params, Progress& progress,
                                 std::function<machine::Cycles()> charged);
/// A live view with the picture and its number of rays.
observe::ControlPanel make_view(const Visualisation& visualisation);
std::uint64_t worker_memory(const machine::Model& model, const Params& params);    ///< in bytes
std::uint64_t database_memory(const machine::Model& model, const Params& params);  ///< in bytes
/// Adds a processor and allocates memory for its program.
machine::Processor& add_processor(machine::Machine& machine, const std::string& name,
                                  std::uint64_t memory, Role role,
                                  std::shared_ptr<const machine::Model> model = {});
/// Name of a worker's processor: its label, or "workerN" with N from 1 if it has none.
std::string worker_name(const topologies::Topology& workers, int id);
/// Adds a worker's processor.
machine::Processor& add_worker(machine::Machine& machine, const topologies::Topology& workers,
                               int id, const Setup& setup, const Params& params);
/// Allocates memory for the image on the display.
void allocate_image(machine::Processor& display, const renderer::Params& image);
/// Measurements of the coordination process and the display, even if the run was cut short.
Result make_result(Progress& progress, Visualisation& visualisation, machine::End end);
/// Adds the workers' topology, the numbers of tasks done by each processor, and a note about the
/// link that was removed to free a port for the coordinator, if any.
void add_workers(Result& result, const topologies::Topology& asked,
                 const topologies::Topology& wired, const std::map<int, std::uint64_t>& done);

}  // namespace farm
