#pragma once
// The farm of the thesis's chapter 4: a parallel ray tracer that draws a coarse image first and
// refines it ("increasing realism"). The coordinator is linked to the ray database, the display and
// the first worker. The workers form an arbitrary topology; tasks travel along its spanning tree
// (figure 4.10).
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
  renderer::Params image;  ///< the image's size, shading and limits of shading
  std::vector<Limits> stages =
      std::vector<Limits>(1);  ///< successive limits of the interactive phase
  std::vector<Order> script;   ///< the user's orders; the program adds Begin and Leave
  int max_cell = 16;           ///< side of the largest image cell in pixels, a power of two
  CellOrder order = CellOrder::random;
  CellLight cells = CellLight::constant;
  /// Order of computing single pixels. A value other than `cells` overrides `max_cell` and `order`.
  ray_tracing::PixelOrder pixels = ray_tracing::PixelOrder::cells;
  /// A coarse picture that the display draws before the first ray (thesis, 4.1). If absent, the
  /// display starts black.
  std::optional<renderer::PreviewStep> preview;
  Weights weights;                     ///< weights for stages and orders that set none
  snapshots::Schedule snapshot_times;  ///< times at which the growing picture is recorded
  std::optional<Block> block;          ///< size of a task; if absent, each task is a ray
  std::uint64_t seed = 1;              ///< seed of the random order of cells
  /// Maximum length in bytes of the messages that carry the scene down the tree before the first
  /// task. Workers acknowledge the last of them. With 0, workers have the scene from the start, as
  /// in the thesis's measurements.
  std::uint32_t scene_message = 0;
  /// Memory in bytes; by default as in the model.
  std::optional<std::uint64_t> worker_memory, database_memory;
};

struct Result : ray_tracing::Rendering {
  /// Maximum time in simulated seconds for comparing all rays with new limits.
  std::optional<double> reorder_pause_s;
  double interactive_s = 0;  ///< duration of the interactive phase, part of time_s
  RayStores::Lengths peaks;  ///< maximum number of rays in each store of the database
  std::uint64_t tasks = 0;   ///< number of tasks, which are rays or blocks
  std::size_t peak_tasks_in_farm = 0;
  double drain_s = 0;               ///< part of time_s after the last task was sent
  topologies::Topology topology;    ///< the workers' topology without a link that was removed
  double mean_depth = 0;            ///< mean distance of workers from the coordinator, in links
  machine::Cycles kernel_cycles{};  ///< cycles charged for the workers' tasks
  /// Host time in s of the workers' tasks; only with Setup::profile.
  double kernel_host_s = 0;
};

/// Throws base::BadInput that names the field, the value found and the values expected.
void check(const Params& params);

/// Runs the farm, with workers joined by `setup.topology`. The cost of the ray database always
/// comes from counted operations, never from host timings. A farm does not reroute messages after a
/// fault: it waits for lost workers for ever. Throws base::BadInput if the topology's root has no
/// free port for the coordinator, and machine::Fault.
Result run_farm(const Setup& setup, const renderer::Scene& scene, const Params& params);

// The functions below are shared by this farm and the farm with a distributed scene
// (shared_farm.hpp).

/// `charged` returns the cycles charged so far for the workers' tasks.
Visualisation make_visualisation(const Setup& setup, const renderer::Scene& scene,
                                 const Params& params, Progress& progress,
                                 std::function<machine::Cycles()> charged);
/// Makes a live view that shows the picture and the number of its rays.
observe::ControlPanel make_view(const Visualisation& visualisation);
std::uint64_t worker_memory(const machine::Model& model, const Params& params);    ///< in bytes
std::uint64_t database_memory(const machine::Model& model, const Params& params);  ///< in bytes
/// Adds a processor to the machine and allocates memory for its program.
machine::Processor& add_processor(machine::Machine& machine, const std::string& name,
                                  std::uint64_t memory, Role role,
                                  std::shared_ptr<const machine::Model> model = {});
/// Name of a worker's processor: its label in the topology, or "workerN" (N = 1, 2, ...) without
/// one.
std::string worker_name(const topologies::Topology& workers, int id);
/// Adds a worker's processor.
machine::Processor& add_worker(machine::Machine& machine, const topologies::Topology& workers,
                               int id, const Setup& setup, const Params& params);
/// Allocates memory for the image on the display.
void allocate_image(machine::Processor& display, const renderer::Params& image);
/// Makes a result from the records of the coordination process and the display. The run may have
/// been cut short.
Result make_result(Progress& progress, Visualisation& visualisation, machine::End end);
/// Adds to the result the workers' topology and the number of tasks done by each processor. If
/// `wired` lacks a link of `asked`, which was removed to free a port for the coordinator, adds a
/// note.
void add_workers(Result& result, const topologies::Topology& asked,
                 const topologies::Topology& wired, const std::map<int, std::uint64_t>& done);

}  // namespace farm
