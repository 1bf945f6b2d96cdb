#pragma once
// The central processes of the farm (thesis, 4.3.6.3 to 4.3.6.6): interaction, coordination, ray
// database and visualisation.
#include <functional>
#include <vector>

#include "renderer/image/image.hpp"
#include "renderer/trace/render.hpp"
#include "simulator/farm/messages.hpp"
#include "simulator/farm/ray_stores.hpp"
#include "simulator/machine/model.hpp"

namespace farm {

// The user, scripted: orders sent at simulated dates.
struct Order {
  machine::Seconds at;
  Command command;
};
void interaction(const std::vector<Order>& script, Channel<Command>& into_coordination);

// Stores rays, and gives them back by priority (figure 4.16).
struct RayDatabase {
  RayStores stores;
  machine::OperationCosts cost;
  kernels::RecordBytes bytes;
  void run(Channel<DatabaseRequest>& from_coord, Channel<DatabaseReply>& into_coord);
};

// Adds what each ray contributes to its sample as it arrives (figure 4.17, Eq 4.26 to 4.28).
struct KeyImage {
  machine::Seconds at;
  renderer::Samples samples;
};
struct Visualisation {
  const renderer::Scene& scene;
  const renderer::Params& params;
  machine::OperationCosts cost;
  renderer::Samples samples;
  std::vector<KeyImage> key_images;
  void run(Channel<Intersection>& inp);

 private:
  void update(const Intersection& message, renderer::Work& work);
};

// How the scene goes to the workers before the first task.
struct SceneMessages {
  std::uint64_t bytes = 0;    // of the scene; 0: the workers have it
  std::uint32_t message = 0;  // bytes, at most
  std::size_t workers = 0;    // each acknowledges the last
};
// Feeds the workers with rays from the database, makes new rays from the intersections they
// return, and passes these on to be shown (figure 4.15).
struct CoordinationSetup {
  const renderer::Scene& scene;
  const renderer::Params& params;
  machine::OperationCosts cost;
  kernels::RecordBytes bytes;
  Cells cells;
  std::uint64_t seed;  // of the order of the initial rays
  SceneMessages load;
  std::vector<Limits> stages;  // the interactive phase's parameters, one set after the other
  std::function<void()> on_begin, on_end;  // before the first task, after the last ray
};
struct CoordinationChannels {
  Channel<Command>& from_interaction;
  Channel<Signal>& from_sender;
  Channel<Task>& into_sender;
  Channel<Intersection>& from_workers;
  Channel<DatabaseRequest>& into_database;
  Channel<DatabaseReply>& from_database;
  Channel<Intersection>& into_visualisation;
};
struct CoordinationResult {
  enum class Phase { setup, interactive, non_interactive, ended };

  Phase phase = Phase::setup;
  renderer::RayCounts rays;
  machine::Seconds begun, interactive_ended, ended;
  machine::Seconds last_task;  // handed out
  std::uint64_t tasks = 0;     // handed out
  std::size_t peak_tasks_in_farm = 0;

  // Called by the process: the first task is at hand, one more is in the farm, all is shown.
  void begin(const std::function<void()>& then);
  void note_task(std::size_t in_farm);
  void end(const std::function<void()>& then);
  // Of a run that is cut short: what has not come yet came now.
  void cut(machine::Seconds now);
};
// `result` is always up to date.
void coordination(const CoordinationSetup& setup, CoordinationChannels channels,
                  CoordinationResult& result);

// A farm whose task is a block of pixels, with all of their rays: the centre hands out blocks,
// from the top of the image, and has no rays to store.
struct Block {
  int width = 0, height = 0;  // pixels
};
std::vector<renderer::Area> make_blocks(const renderer::Params& params, Block size);
struct BlockSetup {
  std::vector<renderer::Area> blocks;
  SceneMessages load;
  std::function<void()> on_begin, on_end;
};
void block_coordination(const BlockSetup& setup, CoordinationChannels channels,
                        CoordinationResult& result);

// Sends the scene to all workers, and waits until they have it. Nobody's task is under way, and the
// sender's signal not taken.
void send_scene(CoordinationChannels channels, SceneMessages load);

// Stops every process of the farm, in the order of the wires, once nothing is in it.
void stop_all(CoordinationChannels channels, bool sender_is_ready);

}  // namespace farm
