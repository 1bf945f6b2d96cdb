#pragma once
// IIRRA, the system of the thesis's chapter 5: processors of one kind, each with a router and one
// sequential process, in which application, data manager and task manager take turns (figure 5.4).
// In a double node the application and the task manager are on a second processor.
// One coordinates and serves data, one shows the picture, the others compute it.
#include "simulator/declare/program.hpp"
#include "simulator/iirra/balance.hpp"
#include "simulator/iirra/record.hpp"
#include "simulator/observe/watch.hpp"
#include "simulator/tracing/busy.hpp"
#include "simulator/tracing/data.hpp"
#include "simulator/tracing/pixel_order.hpp"
#include "simulator/tracing/session.hpp"

namespace iirra {

using tracing::Role;
constexpr int SERVICES = 2;  ///< processors that do not compute: the coordinator, the display

/// Who has which cells at first.
enum class Start : std::uint8_t {
  scattered,  ///< in each macro-cell of sqrt(workers) x sqrt(workers) cells, one each (figure 5.24)
  blocks,     ///< a part of the image each
  subsampled  ///< by the time that a sample of each cell takes (Badouel, 1990)
};

using Order = tracing::Order<Limits>;

struct Params {
  renderer::Params image;
  std::vector<Limits> stages = std::vector<Limits>(1);  ///< one after the other
  std::vector<Order> script;                            ///< in the order of their times
  int max_cell = 16;  ///< pixels, side of the first cells; a power of two, 2 to MAX_CELL
  CellOrder order = CellOrder::bayer;
  tracing::PixelOrder pixels = tracing::PixelOrder::cells;  ///< else of cells, in place of `order`
  Weights weights;  ///< of stages and orders that have none of their own
  Start start = Start::scattered;
  BalanceMethod balance = BalanceMethod::neighbours;
  int reserve = 1;     ///< active tasks that a worker does not give away; with fewer it asks
  bool is_far = true;  ///< the display is as far from the coordinator as can be; else beside it
  /// A worker's data manager has a processor of its own, on the same memory (6.2).
  bool is_double = false;
  bool is_polled = true;     ///< the display asks for pictures; else they are sent to it
  int polls = 4;             ///< questions of the display that wait for an answer at once, at most
  bool has_borders = false;  ///< each picture comes once more, with its cells' borders
  double frame_s = 0.04;     ///< the display asks no worker more often than it shows a frame
  std::uint64_t seed = 1;    ///< of the order `random` and `adaptive`
  growth::Looks looks;
  network::Method method = network::Method::green;
  std::optional<std::size_t> buffers;             ///< of each router; none: enough for every worker
  std::optional<shared_memory::DataParams> data;  ///< none: every processor holds the scene
  std::optional<std::uint64_t> memory;            ///< bytes of each processor; else the model's
  std::vector<programs::PlannedFault> faults;
  programs::OtherModels others;             ///< by number of processor
  std::optional<double> cycles_per_host_s;  ///< as farm::Params
  machine::EngineParams engine = {};
  observe::Watch* watch = nullptr;
};
constexpr int MAX_CELL = 512;

/// Where the roles are on a topology.
struct Places {
  int coordinator = 0, display = 0;
  std::vector<int> workers;  ///< ascending
};
/// Throws base::BadInput for a topology of fewer than three processors.
Places find_places(const topologies::Topology& topology, bool is_far);

/// The worker, as a place among `workers`, of each of the cells that tile the area, row by row.
std::vector<int> assign(Start start, int columns, int rows, int workers);
/// The cells of `side` that tile an area, row by row; the last ones reach beyond it.
std::vector<SampledCell> make_cells(const renderer::Area& area, int side);

/// Throws base::BadInput naming the key, what was found and what was expected.
void check(const Params& params, const topologies::Topology& topology);

struct Result : Record {
  explicit Result(Record record) : Record(std::move(record)) {}
  int workers = 0;
  double mean_depth = 0;                     ///< links from the coordinator to a worker, on average
  std::optional<tracing::SharedUse> shared;  ///< where the scene's data are
  network::RouterUse routers;
  machine::Cycles kernel_cycles{};
  double kernels_s = 0;  ///< the time that they take
};

/// `tree`: the way of messages to all; none: each sender has one. Throws base::BadInput as check(),
/// and if buffers and caches do not fit the memory. Throws machine::Fault as any run, and when a
/// processor stops (its cells are lost) or a message cannot reach its receiver.
Result run_iirra(const machine::Model& model, const topologies::Topology& topology,
                 const topologies::RoutingTable& routes,
                 const std::optional<topologies::TreeLinks>& tree, const renderer::Scene& scene,
                 const Params& params);

}  // namespace iirra
