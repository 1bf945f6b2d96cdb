#pragma once
// The processes at the farm's centre (thesis, 4.3.6.3 to 4.3.6.6): interaction, ray database,
// visualisation, and the coordination, which hands tasks out, in two kinds.
#include "simulator/farm/messages.hpp"
#include "simulator/observe/use.hpp"
#include "simulator/tracing/orders.hpp"
#include "simulator/tracing/rendering.hpp"

namespace farm {

using Order = tracing::Order<Limits>;

/// Stores rays, and gives them back by priority (figure 4.16).
struct RayDatabase {
  RayStores stores;
  machine::OperationCosts cost;
  kernels::RecordBytes bytes;
  kernels::MessageCosts message;
  double longest_pause_s = 0;  ///< while all rays were classified again
  void run(Channel<DatabaseRequest>& from_coord, Channel<DatabaseReply>& into_coord);
};

struct Progress;

/// Adds what each ray contributes to its sample as it arrives (figure 4.17, Eq 4.26 to 4.28), and
/// paints what the sample shows of its cell.
struct Visualisation {
  const renderer::Scene& scene;
  const renderer::Params& params;
  kernels::KernelCost cost;
  kernels::MessageCosts message;
  FrameBuffer picture;
  FrameBuffer scratch;  ///< as large, where costs are timed
  growth::Recorder recorder;
  Progress& progress;
  const kernels::KernelCost& tasks;  ///< what the workers compute
  std::vector<tracing::KeyImage> key_images = {};
  std::uint64_t rays = 0;   ///< that are shown
  bool is_changed = false;  ///< the picture, by the last of them

  void run(Channel<Answer>& inp);
  /// The run has ended, or has been cut short: the last picture.
  void end(machine::Seconds at);
  void show(const Intersection& found);
  growth::Shown look() const;
};

/// What a coordination has done so far. It is always up to date, so that a run can be cut short.
struct Progress {
  enum class Phase { setup, interactive, non_interactive, ended };

  explicit Progress(const machine::Machine& machine) : observed(machine) {}

  const machine::Machine& observed;
  Phase phase = Phase::setup;
  bool is_null = false;  ///< no ray is left within the limits, and the user may have more to say
  renderer::RayCounts rays;
  machine::Seconds begun, interactive_since, ended;
  double interactive_s = 0;    ///< in the interactive phase, until `interactive_since`
  machine::Seconds last_task;  ///< handed out
  std::uint64_t tasks = 0;     ///< handed out
  std::size_t peak_tasks_in_farm = 0;
  std::size_t orders = 0;  ///< of the user, that have come
  /// When each order came, and the first pixel was changed by a ray that it had admitted.
  std::vector<std::pair<machine::Seconds, std::optional<machine::Seconds>>> orders_shown;
  bool is_aborted = false;         ///< by the user
  std::vector<std::string> notes;  ///< which of them had no effect, and why
  observe::Use before, after;      ///< use of the machine until `begun`, until `ended`

  /// The time now, counted as the user counts it.
  double since_begun_s() const { return (occam::this_process().now() - begun).value; }

  // Called by the process: the first task is at hand, one more is in the farm, the interactive
  // phase is over, all is shown.
  void begin();
  void note_task(std::size_t in_farm);
  /// One more order of the user's has come. Returns whether it is to be obeyed: not after the end,
  /// nor where there is a reason why it has no effect.
  bool note_order(const std::string& why_without_effect = {});
  /// A ray that an order has admitted has changed the picture.
  void note_changed(std::uint8_t order);
  void end_interactive();
  void begin_interactive();  ///< again
  void end();
  /// The run has been cut short: what has not come yet came now.
  void cut();
};

/// The user: begins, orders and leaves; then the farm ends when the image is complete.
void interaction(tracing::Orders<Limits>& orders, const Progress& progress,
                 Channel<Command>& into_coordination);

/// How the scene goes to the workers before the first task.
struct SceneMessages {
  std::uint64_t bytes = 0;          ///< size of the scene; 0 if the workers have it
  std::uint32_t message = 0;        ///< bytes, at most
  std::uint64_t display_bytes = 0;  ///< surfaces and lights, which the display needs (4.3.6.6)
  std::size_t workers = 0;          ///< each acknowledges the last message
};

struct CoordinationChannels {
  Channel<Command>& from_interaction;
  Channel<Signal>& from_sender;
  Channel<Task>& into_sender;
  Channel<Answer>& from_workers;
  Channel<DatabaseRequest>& into_database;
  Channel<DatabaseReply>& from_database;
  Channel<Answer>& into_visualisation;
};

/// Feeds the workers with rays from the database, makes new rays from the intersections they
/// return, and passes these on to be shown (figure 4.15).
struct CoordinationSetup {
  const renderer::Scene& scene;
  const renderer::Params& params;
  kernels::KernelCost& cost;  ///< of shading
  kernels::RecordBytes bytes;
  kernels::MessageCosts message;
  Cells cells;
  std::uint64_t seed;  ///< for the order of the initial rays
  SceneMessages load;
  std::vector<Limits> stages;   ///< the interactive phase's parameters, one set after the other
  machine::Cycles cell_judged;  ///< a sample compared with a neighbour
};
void coordination(const CoordinationSetup& setup, CoordinationChannels channels,
                  Progress& progress);

/// The image's blocks, from the top.
std::vector<renderer::Area> make_blocks(const renderer::Params& params, Block size);

/// Hands out blocks of pixels in their order, each with all of its rays: no ray is stored.
void block_coordination(const std::vector<renderer::Area>& blocks, SceneMessages load,
                        CoordinationChannels channels, Progress& progress);

}  // namespace farm
