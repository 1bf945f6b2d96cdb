#pragma once
// Processes around the coordination at the farm's centre: interaction, ray database and
// visualisation (thesis, 4.3.6.4 to 4.3.6.6).
#include "simulator/farm/messages.hpp"
#include "simulator/farm/progress.hpp"
#include "simulator/ray_tracing/orders.hpp"
#include "simulator/ray_tracing/rendering.hpp"

namespace farm {

using Order = ray_tracing::Order<Limits>;

/// Stores rays and returns them by priority (figure 4.16).
struct RayDatabase {
  RayStores stores;
  machine::OperationCosts cost;
  kernels::RecordBytes bytes;
  kernels::MessageCosts message;
  double longest_pause_s = 0;  ///< longest time to reclassify all rays
  void run(Channel<DatabaseRequest>& from_coord, Channel<DatabaseReply>& into_coord);
};

/// Adds each ray's contribution to its sample (figure 4.17, Eq 4.26 to 4.28), and paints the part
/// of the sample's cell that it shows.
struct Visualisation {
  const renderer::Scene& scene;
  const renderer::Params& params;
  kernels::KernelCost cost;
  kernels::MessageCosts message;
  FrameBuffer picture;
  FrameBuffer scratch;  ///< of the same size if costs are timed; else empty
  snapshots::Recorder recorder;
  Progress& progress;
  const kernels::KernelCost& tasks;  ///< cost of the workers' tasks
  std::vector<ray_tracing::KeyImage> key_images = {};
  std::uint64_t rays = 0;   ///< shown in the picture
  bool is_changed = false;  ///< whether the last ray changed the picture

  void run(Channel<Answer>& inp);
  /// Records the last picture, after the run's end or after it was cut short.
  void end(machine::Seconds at);
  void show(const Intersection& found);
  snapshots::Snapshot look() const;
};

/// The user's process: sends Begin, orders, Leave. The farm ends when the image is complete.
void interaction(ray_tracing::Orders<Limits>& orders, const Progress& progress,
                 Channel<Command>& into_coordination);

}  // namespace farm
