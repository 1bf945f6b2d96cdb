#pragma once
// The processes around the coordination at the farm's centre (thesis, 4.3.6.4 to 4.3.6.6):
// interaction, ray database and visualisation.
#include "simulator/farm/messages.hpp"
#include "simulator/farm/progress.hpp"
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

/// The user: begins, orders and leaves; then the farm ends when the image is complete.
void interaction(tracing::Orders<Limits>& orders, const Progress& progress,
                 Channel<Command>& into_coordination);

}  // namespace farm
