#pragma once
// IIRRA, the system of the thesis's chapter 5. Each processor has a router and one sequential
// process, which alternates between application, data manager and task manager (figure 5.4). In a
// double node, application and task manager run on a second processor. One processor coordinates
// and serves data, one displays the picture, and all others compute it.
#include "simulator/iirra/record.hpp"
#include "simulator/iirra/tasks/balance.hpp"
#include "simulator/observe/run_monitor.hpp"
#include "simulator/programs/declare/program.hpp"
#include "simulator/ray_tracing/busy.hpp"
#include "simulator/ray_tracing/data.hpp"
#include "simulator/ray_tracing/pixel_order.hpp"
#include "simulator/ray_tracing/session.hpp"

namespace iirra {

using programs::Setup;
using ray_tracing::Role;
constexpr int SERVICES = 2;  ///< number of processors that do not compute: coordinator and display

/// Initial distribution of cells to the workers.
enum class Start : std::uint8_t {
  scattered,  ///< one cell of each macro-cell for each worker (figure 5.24)
  blocks,     ///< each worker gets one part of the image
  subsampled  ///< balanced by the measured time for one sample of each cell (Badouel, 1990)
};

using Order = ray_tracing::Order<Limits>;

struct Params {
  renderer::Params image;
  /// Successive limits of the interactive phase.
  std::vector<Limits> stages = std::vector<Limits>(1);
  std::vector<Order> script;  ///< the user's orders, ascending in time
  int max_cell = 16;  ///< side of the first cells in pixels, a power of two from 2 to MAX_CELL
  CellOrder order = CellOrder::bayer;
  /// If not `cells`, this order of pixels replaces `order`.
  ray_tracing::PixelOrder pixels = ray_tracing::PixelOrder::cells;
  Weights weights;  ///< default for stages and orders without weights
  Start start = Start::scattered;
  BalanceMethod balance = BalanceMethod::neighbours;
  int reserve = 1;     ///< number of tasks that a worker keeps; with fewer, it requests some
  bool is_far = true;  ///< display as far as possible from the coordinator, else beside it
  /// Each worker's data manager has a processor of its own on the same memory (6.2).
  bool is_double = false;
  bool is_polled = true;     ///< the display polls for pictures; otherwise workers send them
  int polls = 4;             ///< maximum number of unanswered polls
  bool has_borders = false;  ///< records each picture a second time, with borders of cells
  double frame_s = 0.04;     ///< minimum time between two polls of a worker in seconds
  std::uint64_t seed = 1;    ///< seed for the values `random` and `adaptive` of `order`
  snapshots::Schedule snapshot_times;
  network::Method method = network::Method::green;
  std::optional<std::size_t> buffers;             ///< per router; by default enough for all workers
  std::optional<shared_memory::DataParams> data;  ///< if absent, all processors hold the scene
  std::optional<std::uint64_t> memory;            ///< bytes per processor; default: the model's
};
constexpr int MAX_CELL = 512;

/// The processors of each role.
struct Places {
  int coordinator = 0, display = 0;
  std::vector<int> workers;  ///< in ascending order
};
/// Chooses the processors of each role. Throws base::BadInput if there are fewer than three.
Places find_places(const topologies::Topology& topology, bool is_far);

/// Assigns the cells of a tiled area, row by row. Returns each cell's worker as an index into
/// `workers`.
std::vector<int> assign(Start start, int columns, int rows, int workers);
/// Tiles an area with cells of `side` pixels, row by row. The last cells may extend beyond the
/// area.
std::vector<SampledCell> make_cells(const renderer::Area& area, int side);

/// Throws base::BadInput that names the key, the value found and the values expected.
void check(const Params& params, const topologies::Topology& topology);

struct Result : Record {
  explicit Result(Record record) : Record(std::move(record)) {}
  int workers = 0;
  double mean_depth = 0;                         ///< mean distance from the coordinator, in links
  std::optional<ray_tracing::SharedUse> shared;  ///< set if the scene is distributed
  network::RouterUse routers;
  machine::Cycles kernel_cycles{};
  double kernels_s = 0;  ///< duration of kernel_cycles in seconds
};

/// Runs IIRRA. Throws base::BadInput as check() does, or if buffers and caches exceed the memory.
/// Throws machine::Fault, also if a processor stops (its cells are then lost) or if a message
/// cannot reach its receiver.
Result run_iirra(const Setup& setup, const renderer::Scene& scene, const Params& params);

}  // namespace iirra
