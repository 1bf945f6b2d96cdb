#include "simulator/farm/ray_stores.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

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

namespace {

renderer::Ray pop_back(std::vector<renderer::Ray>& store) {
  renderer::Ray ray = store.back();
  store.pop_back();
  return ray;
}

}  // namespace

void RayStores::add(const renderer::Ray& ray, DatabaseWork& work) {
  ++work.record_stored;
  ++work.ray_classified;
  if (ray.kind == renderer::RayKind::shadow) {
    feelers_.push_back(ray);
  } else if (is_interactive(ray, limits_, cells_)) {
    heap_.push_back(ray);
    sift_up(heap_.size() - 1, work);
  } else {
    later_.push_back(ray);
  }
  note_peaks();
}

std::optional<renderer::Ray> RayStores::take(bool any, DatabaseWork& work) {
  if (size() == 0 || (!any && feelers_.empty() && heap_.empty())) return std::nullopt;
  ++work.record_stored;
  if (!feelers_.empty()) return pop_back(feelers_);
  if (heap_.empty()) return pop_back(later_);
  std::swap(heap_.front(), heap_.back());
  const renderer::Ray first = pop_back(heap_);
  sift_down(0, work);
  return first;
}

void RayStores::set_limits(const Limits& limits, DatabaseWork& work) {
  limits_ = limits;
  const auto heap = std::exchange(heap_, {}), later = std::exchange(later_, {});
  auto classify = [&](const std::vector<renderer::Ray>& rays, bool was_interactive) {
    for (const auto& ray : rays) {
      const bool now = is_interactive(ray, limits_, cells_);
      ++work.ray_classified;
      if (now != was_interactive) ++work.record_stored;
      (now ? heap_ : later_).push_back(ray);
    }
  };
  classify(heap, true);
  classify(later, false);
  for (std::size_t i = heap_.size() / 2; i-- > 0;) sift_down(i, work);
  note_peaks();
}

void RayStores::sift_up(std::size_t i, DatabaseWork& work) {
  for (; i > 0 && before(i, (i - 1) / 2); i = (i - 1) / 2) {
    std::swap(heap_[i], heap_[(i - 1) / 2]);
    ++work.heap_step;
  }
}

void RayStores::sift_down(std::size_t i, DatabaseWork& work) {
  for (;;) {
    std::size_t first = i;
    for (std::size_t child : {2 * i + 1, 2 * i + 2})
      if (child < heap_.size() && before(child, first)) first = child;
    if (first == i) return;
    std::swap(heap_[i], heap_[first]);
    ++work.heap_step;
    i = first;
  }
}

void RayStores::note_peaks() {
  peaks_.feelers = std::max(peaks_.feelers, feelers_.size());
  peaks_.heap = std::max(peaks_.heap, heap_.size());
  peaks_.later = std::max(peaks_.later, later_.size());
}

}  // namespace farm
