#include "simulator/farm/rays/ray_stores.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "simulator/kernels/counted_heap.hpp"

namespace farm {

bool is_interactive(const renderer::Ray& ray, const Limits& limits, const Cells& cells) {
  if (ray.kind == renderer::RayKind::shadow) return true;
  const int depth = ray.through ? limits.depth_transmitted : limits.depth_reflected;
  if (ray.level > depth || renderer::max_influence(ray) < limits.min_influence) return false;
  if (cells.size_of(ray.sample) < limits.min_cell) return false;
  if (limits.area.width == 0) return true;
  const auto seen = cells.area_of(ray.sample, limits.area);
  return seen.width > 0 && seen.height > 0;
}

namespace {

int size_of_cell(const renderer::Ray& ray, const Cells& cells) {
  constexpr int URGENCY = 4;
  return cells.size_of(ray.sample) * (ray.is_urgent ? URGENCY : 1);
}

double eval_priority(const renderer::Ray& ray, const Cells& cells, const Weights& weights) {
  const double largest = std::max(1.0, std::log2(cells.max_cell));
  return weights.influence * renderer::max_influence(ray) + weights.level / ray.level +
         weights.cell * std::log2(size_of_cell(ray, cells)) / largest;
}

}  // namespace

bool goes_before(const renderer::Ray& a, const renderer::Ray& b, const Cells& cells,
                 const Weights& weights) {
  if (a.pass != b.pass) return a.pass < b.pass;
  if (weights != Weights{}) {
    const double pa = eval_priority(a, cells, weights), pb = eval_priority(b, cells, weights);
    if (pa != pb) return pa > pb;
  } else {
    const double fa = renderer::max_influence(a), fb = renderer::max_influence(b);
    if (fa != fb) return fa > fb;
    if (a.level != b.level) return a.level < b.level;
    const int ca = size_of_cell(a, cells), cb = size_of_cell(b, cells);
    if (ca != cb) return ca > cb;
  }
  return cells.place_of(a.sample) < cells.place_of(b.sample);
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
    work.heap_step += kernels::sift_up(heap_, heap_.size() - 1, before());
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
  work.heap_step += kernels::sift_down(heap_, 0, before());
  return first;
}

void RayStores::set_limits(const Limits& limits, DatabaseWork& work, std::uint8_t order) {
  limits_ = limits;
  const auto heap = std::exchange(heap_, {}), later = std::exchange(later_, {});
  auto classify = [&](const std::vector<renderer::Ray>& rays, bool was_interactive) {
    for (auto ray : rays) {
      const bool now = is_interactive(ray, limits_, cells_);
      if (now && !was_interactive) ray.order = order;
      ++work.ray_classified;
      if (now != was_interactive) ++work.record_stored;
      (now ? heap_ : later_).push_back(ray);
    }
  };
  classify(heap, true);
  classify(later, false);
  work.heap_step += kernels::make_heap(heap_, before());
  note_peaks();
}

void RayStores::note_peaks() {
  peaks_.feelers = std::max(peaks_.feelers, feelers_.size());
  peaks_.heap = std::max(peaks_.heap, heap_.size());
  peaks_.later = std::max(peaks_.later, later_.size());
}

}  // namespace farm
