#pragma once
// The farm's coordination (thesis, 4.3.6.3): the process that hands tasks out, in two kinds.
#include "simulator/farm/centre.hpp"
#include "simulator/observe/use.hpp"

namespace farm {

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
  observe::Use before, after;  ///< use of the machine until `begun`, until `ended`

  // Called by the process: the first task is at hand, one more is in the farm, the interactive
  // phase is over, all is shown.
  void begin();
  void note_task(std::size_t in_farm);
  void end_interactive();
  void end();
  /// The run has been cut short: what has not come yet came now.
  void cut();
};

/// How the scene goes to the workers before the first task.
struct SceneMessages {
  std::uint64_t bytes = 0;    ///< of the scene; 0 if the workers have it
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
  machine::OperationCosts cost;
  kernels::RecordBytes bytes;
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
struct BlockSetup {
  std::vector<renderer::Area> blocks;
  SceneMessages load;
};
void block_coordination(const BlockSetup& setup, CoordinationChannels channels, Progress& progress);

}  // namespace farm
