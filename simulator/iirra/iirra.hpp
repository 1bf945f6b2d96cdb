#pragma once
// IIRRA, the parallel ray tracer of the thesis's chapter 5. It draws a coarse image first and
// refines it. Each processor has a router and one sequential process, which alternates between
// application (ray tracing), data manager and task manager (figure 5.4). In a double node,
// application and task manager run on a second processor. One processor coordinates and serves
// data, one displays the picture, and all others are workers, which compute it.
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

/// Initial distribution of image cells to the workers.
enum class Start : std::uint8_t {
  /// Each macro-cell (a group of adjacent cells) has one cell for each worker (figure 5.24).
  scattered,
  blocks,     ///< each worker gets adjacent cells of a Z-order curve
  subsampled  ///< balances the workers by the measured time of one sample per cell (Badouel, 1990)
};

using Order = ray_tracing::Order<Limits>;

struct Params {
  renderer::Params image;
  /// Successive limits of the interactive phase.
  std::vector<Limits> stages = std::vector<Limits>(1);
  std::vector<Order> script;  ///< the user's orders, by ascending time
  int max_cell = 16;  ///< side of the largest cells in pixels: a power of two from 2 to MAX_CELL
  CellOrder order = CellOrder::bayer;
  /// Order of computing single pixels. A value other than `cells` overrides `order`, the order of
  /// cells.
  ray_tracing::PixelOrder pixels = ray_tracing::PixelOrder::cells;
  Weights weights;  ///< weights for stages and orders that set none
  Start start = Start::scattered;
  BalanceMethod balance = BalanceMethod::neighbours;
  int reserve = 1;  ///< minimum number of tasks of a worker; a worker with fewer requests more
  /// If true, the display is as far as possible from the coordinator; if false, next to it.
  bool is_far = true;
  /// If true, each worker's data manager has a processor of its own, with the same memory (thesis,
  /// 6.2).
  bool is_double = false;
  /// If true, the display polls workers for pictures; if false, workers send them unasked.
  bool is_polled = true;
  int polls = 4;  ///< maximum number of unanswered polls
  /// If true, a second version of each picture shows the borders of cells.
  bool has_borders = false;
  double frame_s = 0.04;   ///< minimum time in s between two polls of a worker
  std::uint64_t seed = 1;  ///< seed for the values `random` and `adaptive` of `order`
  snapshots::Schedule snapshot_times;
  network::Method method = network::Method::green;
  /// Number of buffers of each router; by default enough for all workers.
  std::optional<std::size_t> buffers;
  std::optional<shared_memory::DataParams> data;  ///< if absent, all processors hold the scene
  std::optional<std::uint64_t> memory;            ///< bytes per processor; default: the model's
};
constexpr int MAX_CELL = 512;

/// The processors of each role.
struct Places {
  int coordinator = 0, display = 0;
  std::vector<int> workers;  ///< numbers of the workers, in ascending order
};
/// Chooses the processors of each role. Throws base::BadInput if there are fewer than three.
Places find_places(const topologies::Topology& topology, bool is_far);

/// Assigns the cells of an area of `columns` times `rows` cells to workers. Returns, row by row,
/// each cell's worker as an index into the list of workers.
std::vector<int> assign(Start start, int columns, int rows, int workers);
/// Tiles an area with square cells of `side` pixels, row by row. Cells in the last column or row
/// may extend beyond the area.
std::vector<SampledCell> make_cells(const renderer::Area& area, int side);

/// Throws base::BadInput that names the key, the value found and the values expected.
void check(const Params& params, const topologies::Topology& topology);

struct Result : Record {
  explicit Result(Record record) : Record(std::move(record)) {}
  int workers = 0;
  double mean_depth = 0;  ///< mean distance of workers from the coordinator, in links
  std::optional<ray_tracing::SharedUse> shared;  ///< set if the scene is distributed
  network::RouterUse routers;
  machine::Cycles kernel_cycles{};  ///< cycles charged for ray tracing on all workers
  double kernels_s = 0;             ///< duration of kernel_cycles in seconds
};

/// Runs IIRRA. Throws base::BadInput if check() would, or if buffers and caches exceed the memory.
/// Throws machine::Fault, also if a processor stops (its image cells are then lost) or if a message
/// cannot reach its receiver.
Result run_iirra(const Setup& setup, const renderer::Scene& scene, const Params& params);

}  // namespace iirra
