// Checks of the farm's parameters.
#include <bit>

#include "simulator/farm/farm.hpp"
#include "simulator/ray_tracing/snapshot_fields.hpp"

namespace farm {

using ray_tracing::PixelOrder;

namespace {

void check_area(renderer::Params image, const renderer::Area& area) {
  image.area = area;
  check(image);
}

// Stages and orders of the user select rays in the ray database. If tasks are blocks of pixels, the
// database holds no rays. This function therefore refuses blocks with stages or orders.
void check_block(const Params& params) {
  if (!params.block) return;
  const Block& block = *params.block;
  if (block.width < 1 || block.height < 1)
    base::refuse("farm.task", "found a block of {}x{} pixels, expected 1x1 or more", block.width,
                 block.height);
  if (params.stages != std::vector<Limits>(1) || !params.script.empty())
    base::refuse("farm.task",
                 "found a block, expected \"ray\": stages and orders apply to single rays only");
}

// With image.order "quadrants" or "scan", all image cells have one size. Refuses parameters that
// need cells of several sizes.
void check_order(const Params& params) {
  if (params.pixels == PixelOrder::cells) return;
  constexpr auto EXPECTED = "found {}, expected {} unless image.order is \"cells\"";
  if (params.cells == CellLight::smooth && params.pixels == PixelOrder::quadrants)
    base::refuse("farm.cells", EXPECTED, "smooth", "constant or point");
  const auto check_limits = [&](const Limits& limits) {
    if (limits.min_cell > 1) base::refuse("min_cell", EXPECTED, limits.min_cell, "1");
  };
  for (const Limits& limits : params.stages) check_limits(limits);
  for (const Order& order : params.script)
    if (const auto* limits = std::get_if<Limits>(&order.what)) check_limits(*limits);
}

}  // namespace

void check(const Params& params) {
  check(params.image);
  check_script(params.script);
  ray_tracing::check_snapshots("farm", params.snapshot_times, params.image);
  if (params.max_cell < 1 || !std::has_single_bit(static_cast<unsigned>(params.max_cell)))
    base::refuse("farm.max_cell", "found {}, expected a power of two", params.max_cell);
  check_block(params);
  check_order(params);
  if (params.stages.empty()) base::refuse("stages", "found none, expected at least one");
  for (const Limits& limits : params.stages) check_area(params.image, limits.area);
  for (const Order& order : params.script)
    if (const auto* limits = std::get_if<Limits>(&order.what))
      check_area(params.image, limits->area);
}

}  // namespace farm
