#pragma once
// The coordination process at the farm's centre. It distributes either rays (thesis, 4.3.6.3) or
// blocks of pixels to the workers.
#include "simulator/farm/messages.hpp"
#include "simulator/farm/progress.hpp"
#include "simulator/farm/rays/cells.hpp"
#include "simulator/ray_tracing/rendering.hpp"

namespace farm {

/// Parameters of the messages that distribute the scene before the first task.
struct SceneMessages {
  std::uint64_t bytes = 0;    ///< size of the scene; 0 if the workers already have it
  std::uint32_t message = 0;  ///< maximum length of a message in bytes
  /// Bytes of surfaces and lights, which the display needs (thesis, 4.3.6.6).
  std::uint64_t display_bytes = 0;
  std::size_t workers = 0;  ///< number of workers; each acknowledges the last message
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

/// Parameters of the process that distributes rays. It sends rays from the ray database to the
/// workers, which return intersections. It makes the child rays of each intersection and forwards
/// the intersection to the display (thesis, figure 4.15).
struct CoordinationSetup {
  const renderer::Scene& scene;
  const renderer::Params& params;
  kernels::KernelCost& cost;  ///< cost of shading
  kernels::RecordBytes bytes;
  kernels::MessageCosts message;
  Cells cells;
  std::uint64_t seed;  ///< seed of the order of the initial rays
  SceneMessages load;
  std::vector<Limits> stages;   ///< successive limits of the interactive phase
  machine::Cycles cell_judged;  ///< cost of comparing one sample with one neighbour
};
void coordination(const CoordinationSetup& setup, CoordinationChannels channels,
                  Progress& progress);

/// Divides the computed area of the image into blocks, row by row from the top.
std::vector<renderer::Area> make_blocks(const renderer::Params& params, Block size);

/// Process that distributes blocks of pixels in the given order. A worker traces all rays of a
/// block, so the ray database stays empty.
void block_coordination(const std::vector<renderer::Area>& blocks, SceneMessages load,
                        CoordinationChannels channels, Progress& progress);

}  // namespace farm
