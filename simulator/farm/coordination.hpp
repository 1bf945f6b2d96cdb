#pragma once
// The coordination at the farm's centre, in two kinds: it hands out rays (thesis, 4.3.6.3), or
// blocks of pixels.
#include "simulator/farm/messages.hpp"
#include "simulator/farm/progress.hpp"
#include "simulator/farm/rays/cells.hpp"
#include "simulator/tracing/rendering.hpp"

namespace farm {

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
