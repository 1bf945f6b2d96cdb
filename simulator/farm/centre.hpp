#pragma once
// The processes that support the coordination at the farm's centre: interaction, ray database and
// visualisation (thesis, 4.3.6.4 to 4.3.6.6).
#include "simulator/farm/messages.hpp"
#include "simulator/farm/progress.hpp"
#include "simulator/ray_tracing/orders.hpp"
#include "simulator/ray_tracing/rendering.hpp"

namespace farm {

using Order = ray_tracing::Order<Limits>;

/// Process that stores rays and returns them by priority (figure 4.16).
struct RayDatabase {
  RayStores stores;
  machine::OperationCosts cost;
  kernels::RecordBytes bytes;
  kernels::MessageCosts message;
  double longest_pause_s = 0;  ///< maximum time for reclassifying all rays
  void run(Channel<DatabaseRequest>& from_coord, Channel<DatabaseReply>& into_coord);
};

/// Process that adds each ray's contribution to its sample (figure 4.17, Eq 4.26 to 4.28) and
/// paints the sample's cell.
struct Visualisation {
  const renderer::Scene& scene;
  const renderer::Params& params;
  kernels::KernelCost cost;
  kernels::MessageCosts message;
  FrameBuffer picture;
  FrameBuffer scratch;  ///< as large as `picture` if costs are timed, otherwise empty
  snapshots::Recorder recorder;
  Progress& progress;
  std::function<machine::Cycles()> charged;  ///< cycles charged for the workers' tasks
  std::vector<ray_tracing::KeyImage> key_images = {};
  std::uint64_t rays = 0;   ///< number of rays shown in the picture
  bool is_changed = false;  ///< true if the last ray changed the picture

  void run(Channel<Answer>& inp);
  /// Records the picture if one is due, before a change.
  void note();
  /// Records the final picture of a run, even if the run was cut short.
  void end(machine::Seconds at);
  void show(const Intersection& found);
  snapshots::Snapshot look() const;
};

/// Process of the user: sends Begin, the orders, then Leave. The farm ends when the image is
/// complete.
void interaction(ray_tracing::Orders<Limits>& orders, const Progress& progress,
                 Channel<Command>& into_coordination);

}  // namespace farm
