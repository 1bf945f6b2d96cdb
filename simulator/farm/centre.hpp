#pragma once
// The processes at the farm's centre (thesis, 4.3.6.3 to 4.3.6.6): interaction, ray database,
// visualisation, and the coordination, which hands tasks out, in two kinds.
#include "renderer/image/image.hpp"
#include "simulator/farm/messages.hpp"
#include "simulator/observe/use.hpp"

namespace farm {

/// What the user orders, some time after the first task was at hand.
struct Order {
  machine::Seconds at;
  Command command;
};

/// Stores rays, and gives them back by priority (figure 4.16).
struct RayDatabase {
  RayStores stores;
  machine::OperationCosts cost;
  kernels::RecordBytes bytes;
  kernels::MessageCosts message;
  void run(Channel<DatabaseRequest>& from_coord, Channel<DatabaseReply>& into_coord);
};

/// The image as it was when the limits of a stage were reached.
struct KeyImage {
  machine::Seconds at;
  renderer::Samples samples;
};

/// Adds what each ray contributes to its sample as it arrives (figure 4.17, Eq 4.26 to 4.28).
struct Visualisation {
  const renderer::Scene& scene;
  const renderer::Params& params;
  kernels::KernelCost cost;
  kernels::MessageCosts message;
  renderer::Samples samples;
  std::vector<KeyImage> key_images;
  renderer::Samples scratch = {};  ///< as large as samples, where costs are timed
  void run(Channel<Answer>& inp);
};

/// What a coordination has done so far. It is always up to date, so that a run can be cut short.
struct Progress {
  enum class Phase { setup, interactive, non_interactive, ended };

  explicit Progress(const machine::Machine& machine) : observed(machine) {}

  const machine::Machine& observed;
  Phase phase = Phase::setup;
  renderer::RayCounts rays;
  machine::Seconds begun, interactive_ended, ended;
  machine::Seconds last_task;  ///< handed out
  std::uint64_t tasks = 0;     ///< handed out
  std::size_t peak_tasks_in_farm = 0;
  std::size_t orders = 0;          ///< of the user, that have come
  std::vector<std::string> notes;  ///< which of them had no effect, and why
  observe::Use before, after;      ///< use of the machine until `begun`, until `ended`

  // Called by the process: the first task is at hand, one more is in the farm, the interactive
  // phase is over, all is shown.
  void begin();
  void note_task(std::size_t in_farm);
  /// One more order of the user's has come. Returns whether it is to be obeyed.
  bool note_order(bool is_set_already = false);
  void end_interactive();
  void end();
  /// The run has been cut short: what has not come yet came now.
  void cut();
};

/// The user, scripted: begins, orders and quits when the image is complete.
void interaction(const std::vector<Order>& script, const Progress& progress,
                 Channel<Command>& into_coordination);

/// How the scene goes to the workers before the first task.
struct SceneMessages {
  std::uint64_t bytes = 0;    ///< size of the scene; 0 if the workers have it
  std::uint32_t message = 0;  ///< bytes, at most
  std::size_t workers = 0;    ///< each acknowledges the last message
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
  std::vector<Limits> stages;  ///< the interactive phase's parameters, one set after the other
};
void coordination(const CoordinationSetup& setup, CoordinationChannels channels,
                  Progress& progress);

/// The image's blocks, from the top.
std::vector<renderer::Area> make_blocks(const renderer::Params& params, Block size);

/// Hands out blocks of pixels in their order, each with all of its rays: no ray is stored.
void block_coordination(const std::vector<renderer::Area>& blocks, SceneMessages load,
                        CoordinationChannels channels, Progress& progress);

}  // namespace farm
