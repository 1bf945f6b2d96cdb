#pragma once
// Two kinds of coordination at the farm's centre: of rays (thesis, 4.3.6.3) or of blocks of pixels.
#include "simulator/farm/messages.hpp"
#include "simulator/farm/progress.hpp"
#include "simulator/farm/rays/cells.hpp"
#include "simulator/ray_tracing/rendering.hpp"

namespace farm {

/// Messages that send the scene to the workers before the first task.
struct SceneMessages {
  std::uint64_t bytes = 0;          ///< size of the scene; 0: the workers have it
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

/// Setup of `coordination`: it feeds workers with rays from the database, makes new rays from the
/// returned intersections and passes these on to the display (figure 4.15).
struct CoordinationSetup {
  const renderer::Scene& scene;
  const renderer::Params& params;
  kernels::KernelCost& cost;  ///< of shading
  kernels::RecordBytes bytes;
  kernels::MessageCosts message;
  Cells cells;
  std::uint64_t seed;  ///< for the order of the initial rays
  SceneMessages load;
  std::vector<Limits> stages;   ///< limits of the interactive phase, applied one after another
  machine::Cycles cell_judged;  ///< cost of comparing a sample with a neighbour
};
void coordination(const CoordinationSetup& setup, CoordinationChannels channels,
                  Progress& progress);

/// The image's blocks, row by row from the top.
std::vector<renderer::Area> make_blocks(const renderer::Params& params, Block size);

/// Hands out blocks of pixels in order, each with all its rays; stores no rays.
void block_coordination(const std::vector<renderer::Area>& blocks, SceneMessages load,
                        CoordinationChannels channels, Progress& progress);

}  // namespace farm
