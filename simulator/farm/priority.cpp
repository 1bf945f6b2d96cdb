#include "simulator/farm/priority.hpp"

#include <algorithm>
#include <tuple>

#include "base/random.hpp"

namespace farm {

int Cells::size_of(std::uint32_t sample) const {
  const std::uint32_t w = static_cast<std::uint32_t>(width);
  const std::uint32_t corner = sample % w | sample / w | static_cast<std::uint32_t>(max_cell);
  return static_cast<int>(corner & (~corner + 1));  // lowest bit set
}

bool is_interactive(const renderer::Ray& ray, const Limits& limits, const Cells& cells) {
  if (ray.kind == renderer::RayKind::shadow) return true;
  const int depth = ray.through ? limits.depth_transmitted : limits.depth_reflected;
  if (ray.level > depth || renderer::max_influence(ray) < limits.min_influence) return false;
  if (cells.size_of(ray.sample) < limits.min_cell) return false;
  const auto& area = limits.area;
  if (area.width == 0) return true;
  const int x = static_cast<int>(ray.sample) % cells.width;
  const int y = static_cast<int>(ray.sample) / cells.width;
  return x >= area.x && x < area.x + area.width && y >= area.y && y < area.y + area.height;
}

bool goes_before(const renderer::Ray& a, const renderer::Ray& b, const Cells& cells) {
  const double fa = renderer::max_influence(a), fb = renderer::max_influence(b);
  if (fa != fb) return fa > fb;
  if (a.level != b.level) return a.level < b.level;
  return cells.size_of(a.sample) > cells.size_of(b.sample);
}

std::vector<renderer::Ray> make_initial_rays(const renderer::Scene& scene,
                                             const renderer::Params& params, const Cells& cells,
                                             std::uint64_t seed) {
  const renderer::Area area = renderer::get_area(params);
  std::vector<std::tuple<int, std::uint64_t, std::uint32_t>> order;  // -cell, random, sample
  for (int y = area.y; y < area.y + area.height; ++y)
    for (int x = area.x; x < area.x + area.width; ++x) {
      const auto sample = static_cast<std::uint32_t>(y * params.width + x);
      order.emplace_back(-cells.size_of(sample), base::random_at(seed, sample), sample);
    }
  std::ranges::sort(order);
  std::vector<renderer::Ray> rays;
  rays.reserve(order.size());
  for (const auto& [cell, random, sample] : order) {
    const int s = static_cast<int>(sample);
    rays.push_back(renderer::make_primary(scene.view, params, s % params.width, s / params.width));
  }
  return rays;
}

}  // namespace farm
