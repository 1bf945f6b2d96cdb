#include "simulator/farm/ray_stores.hpp"

#include <algorithm>
#include <utility>

namespace farm {

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
