#include "renderer/trace/params.hpp"

#include <fmt/format.h>

#include "renderer/scene/require.hpp"

namespace renderer {

namespace {

constexpr int MAX_DEPTH = 1000, MAX_AMBIENT = 1000;
constexpr long long MAX_PIXELS = 1LL << 28;

std::string describe_size(int width, int height) { return fmt::format("{} x {}", width, height); }

}  // namespace

void check(const Params& p) {
  const auto size = describe_size(p.width, p.height);
  require(p.width >= 1 && p.width <= MAX_SIDE && p.height >= 1 && p.height <= MAX_SIDE, "size",
          size, fmt::format("1 to {} pixels a side", MAX_SIDE));
  require(1LL * p.width * p.height <= MAX_PIXELS, "size", size,
          fmt::format("at most {} pixels", MAX_PIXELS));
  require(p.limits.depth >= 1 && p.limits.depth <= MAX_DEPTH, "depth", p.limits.depth,
          fmt::format("1 to {}", MAX_DEPTH));
  require(p.limits.min_influence >= 0 && p.limits.min_influence <= 1, "min_influence",
          p.limits.min_influence, "0 to 1");
  require(p.ambient >= 0 && p.ambient <= MAX_AMBIENT, "ambient", p.ambient,
          fmt::format("0 to {}", MAX_AMBIENT));
  const Area a = get_area(p);
  require(a.x >= 0 && a.y >= 0 && a.width >= 1 && a.height >= 1 && a.x <= p.width - a.width &&
              a.y <= p.height - a.height,
          "area", fmt::format("{} at ({}, {})", describe_size(a.width, a.height), a.x, a.y),
          fmt::format("a rectangle of pixels within {}", size));
}

Area get_area(const Params& p) { return p.area == Area{} ? Area{0, 0, p.width, p.height} : p.area; }

}  // namespace renderer
