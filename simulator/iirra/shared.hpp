#pragma once
// What all processes of a run share: what they know before it begins, and the record of it.
#include "simulator/iirra/iirra.hpp"
#include "simulator/shared_memory/scene_items.hpp"
#include "simulator/tracing/orders.hpp"

namespace iirra {

/// A ray, traced.
struct Traced {
  std::optional<renderer::Hit> hit;
  renderer::Rgb contribution;
  renderer::Children children;
};

struct Shared {
  const renderer::Scene& scene;
  const Params& params;
  const machine::Machine& machine;
  Places places;
  renderer::Area area;  ///< of the image that is computed
  Sizes sizes;
  std::uint64_t longest;  ///< bytes of a message
  kernels::ByModel<machine::OperationCosts> task_cost;
  kernels::ByModel<machine::Cycles>
      pixel_tested;  ///< of the display, which of two pictures of it is newer
  kernels::KernelCost ray_cost, paint_cost, display_cost;
  std::shared_ptr<const CellQuadrants> quadrants = nullptr;  ///< where cells have that order
  const shared_memory::SceneItems* items = nullptr;          ///< where the scene is shared
  machine::Cycles charged_with_data{};                       ///< for rays that read it so
  machine::Seconds charged_with_data_s{};                    ///< the same as time
  tracing::Orders<Limits> orders;                            ///< of the user
  Record record;
  Traced scratch = {};  ///< for replays of rays, where costs are timed

  double now_s() const { return occam_now() - record.begun_s; }
  static double occam_now() { return machine::this_process().now().value; }
  std::uint64_t pixels() const {
    return static_cast<std::uint64_t>(area.width) * static_cast<std::uint64_t>(area.height);
  }
  machine::Cycles kernel_cycles() const { return items ? charged_with_data : ray_cost.charged(); }
  machine::Seconds kernels_s() const { return items ? charged_with_data_s : ray_cost.charged_s(); }
};

}  // namespace iirra
