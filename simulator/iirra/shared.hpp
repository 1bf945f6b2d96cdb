#pragma once
// State shared by all processes of a run: constant inputs, and the record of the run.
#include "simulator/iirra/iirra.hpp"
#include "simulator/ray_tracing/orders.hpp"
#include "simulator/shared_memory/scene_items.hpp"

namespace iirra {

/// The result of tracing a ray.
struct Traced {
  std::optional<renderer::Hit> hit;
  renderer::Rgb contribution;
  renderer::Children children;
};

struct Shared {
  const Setup& setup;
  const renderer::Scene& scene;
  const Params& params;
  const machine::Machine& machine;
  Places places;
  renderer::Area area;  ///< part of the image that is computed
  Sizes sizes;
  std::uint64_t longest;  ///< maximum message length in bytes
  kernels::ByModel<machine::OperationCosts> task_cost;
  kernels::ByModel<machine::Cycles>
      pixel_tested;  ///< the display's cost of finding which of two paintings of a pixel is newer
  kernels::KernelCost ray_cost, paint_cost, display_cost;
  std::shared_ptr<const CellQuadrants> quadrants = nullptr;  ///< only if cells have quadrant order
  const shared_memory::SceneItems* items = nullptr;          ///< only if the scene is distributed
  machine::Cycles charged_with_data{};     ///< cycles charged by kernels that read distributed data
  machine::Seconds charged_with_data_s{};  ///< duration of charged_with_data
  ray_tracing::Orders<Limits> orders;      ///< orders of the user
  Record record;
  Traced scratch = {};  ///< result of ray kernels that run again only to be timed

  double now_s() const { return occam_now() - record.begun_s; }
  static double occam_now() { return machine::this_process().now().value; }
  bool is_outside(const Point& p) const {
    return p.x < area.x || p.y < area.y || p.x >= area.x + area.width ||
           p.y >= area.y + area.height;
  }
  std::uint64_t pixels() const {
    return static_cast<std::uint64_t>(area.width) * static_cast<std::uint64_t>(area.height);
  }
  machine::Cycles kernel_cycles() const { return items ? charged_with_data : ray_cost.charged(); }
  machine::Seconds kernels_s() const { return items ? charged_with_data_s : ray_cost.charged_s(); }
};

/// The memory of the processor of this_process().
inline machine::Memory& own_memory() { return machine::this_process().processor().memory(); }
/// Allocates memory on the processor of this_process(). If too little memory is left, the error
/// names `what`.
inline void allocate(std::uint64_t bytes, const char* what) {
  own_memory().allocate(bytes, what, machine::this_process().own_time());
}

}  // namespace iirra
