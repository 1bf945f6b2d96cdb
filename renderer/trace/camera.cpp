// The checks of Params and the rays of the first level.

#include <fmt/format.h>

#include <stdexcept>

#include "renderer/trace/shade.hpp"

namespace renderer {

namespace {

constexpr int MAX_SIDE = 65536, MAX_DEPTH = 1000;
constexpr long long MAX_PIXELS = 1LL << 28;

void require(bool holds, std::string_view field, const std::string& found,
             const std::string& expected) {
  if (!holds)
    throw std::invalid_argument(fmt::format("{}: found {}, expected {}", field, found, expected));
}

}  // namespace

void check(const Params& p) {
  const auto size = [](int w, int h) { return fmt::format("{} x {}", w, h); };
  require(p.width >= 1 && p.width <= MAX_SIDE && p.height >= 1 && p.height <= MAX_SIDE, "size",
          size(p.width, p.height), fmt::format("1 to {} pixels a side", MAX_SIDE));
  require(1LL * p.width * p.height <= MAX_PIXELS, "size", size(p.width, p.height),
          fmt::format("at most {} pixels", MAX_PIXELS));
  require(p.limits.depth >= 1 && p.limits.depth <= MAX_DEPTH, "depth",
          fmt::format("{}", p.limits.depth), fmt::format("1 to {}", MAX_DEPTH));
  require(p.limits.min_influence >= 0 && p.limits.min_influence <= 1, "min_influence",
          fmt::format("{}", p.limits.min_influence), "0 to 1");
  require(p.ambient >= 0 && p.ambient <= 1000, "ambient", fmt::format("{}", p.ambient),
          "0 to 1000");
  const Area a = get_area(p);
  require(a.x >= 0 && a.y >= 0 && a.width >= 1 && a.height >= 1 && a.x <= p.width - a.width &&
              a.y <= p.height - a.height,
          "area", fmt::format("{} at ({}, {})", size(a.width, a.height), a.x, a.y),
          fmt::format("a rectangle of pixels within {}", size(p.width, p.height)));
}

Area get_area(const Params& p) { return p.area == Area{} ? Area{0, 0, p.width, p.height} : p.area; }

Ray make_primary(const Scene& scene, const Params& p, int x, int y) {
  // Pixels, or the steps between samples that span the view from edge to edge.
  const bool lattice = p.sample == SamplePosition::lattice;
  const double columns = lattice ? p.width - 1 : p.width, rows = lattice ? p.height - 1 : p.height;
  const double shift = p.sample == SamplePosition::center ? 0.5 : 0;
  const View& view = scene.view;
  const double step = 2 * view.half_height / std::max(rows, 1.0);
  Ray ray;
  ray.origin = view.from;
  ray.direction = normalize(view.ahead + (x + shift - columns / 2) * step * view.right +
                            (rows / 2 - y - shift) * step * view.above);
  ray.influence = {1, 1, 1};
  ray.sample = static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(p.width) +
               static_cast<std::uint32_t>(x);
  return ray;
}

}  // namespace renderer
