#include "renderer/trace/render.hpp"

#include <atomic>
#include <mutex>

#include "base/share.hpp"
#include "renderer/scene/require.hpp"
#include "renderer/trace/pixel_tracer.hpp"

namespace renderer {

void RayCounts::add(RayKind kind, bool hit) {
  probes += kind == RayKind::probe;
  primary += kind == RayKind::primary;
  primary_hit += kind == RayKind::primary && hit;
  reflected += kind == RayKind::reflected;
  transmitted += kind == RayKind::transmitted;
  shadow += kind == RayKind::shadow;
}

RayCounts& RayCounts::operator+=(const RayCounts& other) {
  probes += other.probes;
  primary += other.primary;
  primary_hit += other.primary_hit;
  reflected += other.reflected;
  transmitted += other.transmitted;
  shadow += other.shadow;
  return *this;
}

TracedSample SampleTracer::trace(int x, int y, int pass) {
  TracedSample traced;
  stack.push_back(make_primary(scene_.view, params_, x, y, pass));
  while (!stack.empty()) {
    const Ray ray = stack.back();
    stack.pop_back();
    const auto hit = intersect(scene_, ray, params_.traversal, work, access_);
    rays.add(ray.kind, hit.has_value());
    if (ray.level == 1 && hit) traced.object = hit->object;
    add(traced.sums, eval_contribution(scene_, params_, ray, hit, work));
    if (hit) make_children(scene_, params_, ray, *hit, stack, work);
  }
  return traced;
}

std::uint32_t SampleTracer::probe(int x, int y) {
  const auto hit =
      intersect(scene_, make_probe(scene_.view, params_, x, y), params_.traversal, work, access_);
  rays.add(RayKind::probe, hit.has_value());
  return hit ? hit->object : NO_OBJECT;
}

Block render_block(const Scene& scene, const Params& params, const Area& area, Access* access) {
  BlockBuffer buffer;
  render_block(scene, params, area, buffer, access);
  return std::move(buffer.block);
}

void render_block(const Scene& scene, const Params& params, const Area& area, BlockBuffer& buffer,
                  Access* access) {
  Block& block = buffer.block;
  block.area = area;
  block.samples.width = area.width;
  block.samples.height = area.height;
  block.samples.sums.assign(
      static_cast<std::size_t>(area.width) * static_cast<std::size_t>(area.height), {});
  block.counts.assign(is_adaptive(params.sampling) ? block.samples.sums.size() : 0, 0);
  SampleTracer tracer(scene, params, access);
  tracer.stack.swap(buffer.pending);
  CornerObjects corners(params, area);
  for (int row = 0; row < corners.rows(); ++row) corners.find_row(row, tracer);
  PixelTracer pixels(params, area, corners, tracer);
  std::size_t at = 0;
  for (int row = 0; row < area.height; ++row)
    for (int column = 0; column < area.width; ++column, ++at) {
      const auto [sums, count] = pixels.trace(column, row);
      block.samples.sums[at] = sums;
      if (!block.counts.empty()) block.counts[at] = static_cast<std::uint16_t>(count);
    }
  tracer.stack.swap(buffer.pending);
  block.rays = tracer.rays;
  block.work = tracer.work;
}

void add_block(Samples& image, const Block& block, Work& work) {
  image.add(block.area.x, block.area.y, block.samples);
  work[Op::sample_updated] += block.samples.sums.size();
}

void check_threads(int threads) {
  constexpr int MOST = 1024;
  require(threads >= 1 && threads <= MOST, "threads", threads, fmt::format("1 to {}", MOST));
}

Rendering render(const Scene& scene, const Params& params, int threads, const Progress& progress,
                 const IsStopped& is_stopped) {
  check(params);
  check_threads(threads);
  const Area area = get_area(params);
  Rendering result{Samples(params.width, params.height), {}, {}, {}};
  if (is_adaptive(params.sampling)) result.counts.resize(result.samples.sums.size());
  std::mutex one_by_one;
  const auto add_counts = [&](const SampleTracer& tracer) {
    const std::lock_guard lock(one_by_one);
    result.rays += tracer.rays;
    result.work += tracer.work;
  };
  std::atomic<bool> is_ended = false;
  const auto ends = [&] {
    if (is_stopped && is_stopped()) is_ended = true;
    return is_ended.load();
  };
  CornerObjects corners(params, area);
  base::share(corners.rows(), threads, [&](int row) {
    if (ends()) return;
    SampleTracer tracer(scene, params);
    corners.find_row(row, tracer);
    add_counts(tracer);
  });
  int done = 0;
  base::share(area.height, threads, [&](int row) {
    if (is_ended) return;
    SampleTracer tracer(scene, params);
    PixelTracer pixels(params, area, corners, tracer);
    for (int column = 0; column < area.width; ++column) {
      if (is_stopped && ends()) return;
      const auto [sums, count] = pixels.trace(column, row);
      const auto at =
          static_cast<std::size_t>(area.y + row) * static_cast<std::size_t>(params.width) +
          static_cast<std::size_t>(area.x + column);
      result.samples.sums[at] = sums;
      if (!result.counts.empty()) result.counts[at] = static_cast<std::uint16_t>(count);
    }
    add_counts(tracer);
    const std::lock_guard lock(one_by_one);
    ++done;
    if (progress && !progress(done, area.height)) is_ended = true;
  });
  return result;
}

}  // namespace renderer
