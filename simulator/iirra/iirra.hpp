#pragma once
// IIRRA, the system of the thesis's chapter 5. Each processor has a router and one sequential
// process, which alternates between application, data manager and task manager (figure 5.4). In a
// double node, application and task manager have a second processor. One processor coordinates and
// serves data, one shows the picture, the others compute it.
#include "simulator/iirra/balance.hpp"
#include "simulator/iirra/record.hpp"
#include "simulator/observe/run_monitor.hpp"
#include "simulator/programs/declare/program.hpp"
#include "simulator/ray_tracing/busy.hpp"
#include "simulator/ray_tracing/data.hpp"
#include "simulator/ray_tracing/pixel_order.hpp"
#include "simulator/ray_tracing/session.hpp"

namespace iirra {

using ray_tracing::Role;
constexpr int SERVICES = 2;  ///< processors that do not compute: coordinator and display

/// Distribution of the first cells among the workers.
enum class Start : std::uint8_t {
  scattered,  ///< one cell each per macro-cell of sqrt(workers) x sqrt(workers) cells (figure 5.24)
  blocks,     ///< one part of the image each
  subsampled  ///< balanced by the time for a sample of each cell (Badouel, 1990)
};

using Order = ray_tracing::Order<Limits>;

struct Params {
  renderer::Params image;
  std::vector<Limits> stages = std::vector<Limits>(1);  ///< applied one after another
  std::vector<Order> script;                            ///< in order of time
  int max_cell = 16;  ///< side of the first cells, pixels; a power of two from 2 to MAX_CELL
  CellOrder order = CellOrder::bayer;
  ray_tracing::PixelOrder pixels = ray_tracing::PixelOrder::cells;  ///< else replaces `order`
  Weights weights;  ///< for stages and orders without weights of their own
  Start start = Start::scattered;
  BalanceMethod balance = BalanceMethod::neighbours;
  int reserve = 1;     ///< active tasks that a worker keeps; with fewer it requests tasks
  bool is_far = true;  ///< display as far as possible from the coordinator; else beside it
  /// A worker's data manager has its own processor, on the same memory (6.2).
  bool is_double = false;
  bool is_polled = true;     ///< the display polls for pictures; else workers send them unasked
  int polls = 4;             ///< most polls of the display that may be unanswered
  bool has_borders = false;  ///< records each picture again, with its cells' borders
  double frame_s = 0.04;     ///< shortest time between two polls of a worker, s
  std::uint64_t seed = 1;    ///< for the orders `random` and `adaptive`
  snapshots::Schedule snapshot_times;
  network::Method method = network::Method::green;
  std::optional<std::size_t> buffers;             ///< per router; none: enough for all workers
  std::optional<shared_memory::DataParams> data;  ///< none: every processor holds the whole scene
  std::optional<std::uint64_t> memory;            ///< bytes per processor; none: the model's
  std::vector<programs::PlannedFault> faults;
  programs::OtherModels others;             ///< by processor number
  std::optional<double> cycles_per_host_s;  ///< as in farm::Params
  machine::EngineParams engine = {};
  observe::RunMonitor* monitor = nullptr;
};
constexpr int MAX_CELL = 512;

/// Processors of each role.
struct Places {
  int coordinator = 0, display = 0;
  std::vector<int> workers;  ///< ascending
};
/// Throws base::BadInput if the topology has fewer than three processors.
Places find_places(const topologies::Topology& topology, bool is_far);

/// For each cell that tiles the area, row by row: its worker, as an index into `workers`.
std::vector<int> assign(Start start, int columns, int rows, int workers);
/// Cells of `side` pixels that tile an area, row by row; the last may extend beyond it.
std::vector<SampledCell> make_cells(const renderer::Area& area, int side);

/// Throws base::BadInput naming the key, what was found and what was expected.
void check(const Params& params, const topologies::Topology& topology);

struct Result : Record {
  explicit Result(Record record) : Record(std::move(record)) {}
  int workers = 0;
  double mean_depth = 0;  ///< links from the coordinator to a worker, on average
  std::optional<ray_tracing::SharedUse> shared;  ///< set if the scene is distributed
  network::RouterUse routers;
  machine::Cycles kernel_cycles{};
  double kernels_s = 0;  ///< time of kernel_cycles, s
};

/// `tree`: route of broadcasts; none: each sender has its own tree. Throws base::BadInput as
/// check() does, or if buffers and caches exceed the memory. Throws machine::Fault as any run, and
/// if a processor stops (its cells are lost) or a message cannot reach its receiver.
Result run_iirra(const machine::Model& model, const topologies::Topology& topology,
                 const topologies::RoutingTable& routes,
                 const std::optional<topologies::TreeLinks>& tree, const renderer::Scene& scene,
                 const Params& params);

}  // namespace iirra
