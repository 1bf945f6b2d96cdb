#pragma once
// Three processes at the farm's centre that support the coordination process: the user's
// interaction, the ray database and the visualisation (thesis, 4.3.6.4 to 4.3.6.6).
#include "simulator/farm/messages.hpp"
#include "simulator/farm/progress.hpp"
#include "simulator/ray_tracing/orders.hpp"
#include "simulator/ray_tracing/rendering.hpp"

namespace farm {

using Order = ray_tracing::Order<Limits>;

/// Process that stores the untraced rays and returns them by priority (thesis, figure 4.16).
struct RayDatabase {
  RayStores stores;
  machine::OperationCosts cost;
  kernels::RecordBytes bytes;
  kernels::MessageCosts message;
  /// Maximum time in simulated seconds for comparing all rays with new limits.
  double longest_pause_s = 0;
  void run(Channel<DatabaseRequest>& from_coord, Channel<DatabaseReply>& into_coord);
};

/// Process that adds each ray's contribution to the sum of its sample, and paints the image cell of
/// that sample (thesis, figure 4.17, Eq 4.26 to 4.28).
struct Visualisation {
  const renderer::Scene& scene;
  const renderer::Params& params;
  kernels::KernelCost cost;
  kernels::MessageCosts message;
  FrameBuffer picture;
  FrameBuffer scratch;  ///< as large as `picture` if costs are timed, otherwise empty
  snapshots::Recorder recorder;
  Progress& progress;
  /// Returns the cycles charged so far for the workers' tasks.
  std::function<machine::Cycles()> charged;
  std::vector<ray_tracing::KeyImage> key_images = {};
  std::uint64_t rays = 0;   ///< number of rays shown in the picture
  bool is_changed = false;  ///< true if the last ray changed the picture

  void run(Channel<Answer>& inp);
  /// Records the picture if a snapshot is due. Must be called before the picture changes.
  void note();
  /// Records the final picture at the date `at`, even if the run was cut short.
  void end(machine::Seconds at);
  void show(const Intersection& found);
  snapshots::Snapshot look() const;
};

/// Process that stands for the user: sends Begin, the user's orders at their times, then Leave,
/// after which the farm ends as soon as the image is complete.
void interaction(ray_tracing::Orders<Limits>& orders, const Progress& progress,
                 Channel<Command>& into_coordination);

}  // namespace farm
