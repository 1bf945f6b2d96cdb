#include "renderer/trace/render.hpp"

#include <atomic>
#include <future>
#include <mutex>

#include "renderer/scene/require.hpp"

namespace renderer {

namespace {

constexpr int MAX_THREADS = 1024;

// The state of one thread.
struct Tracer {
  const Scene& scene;
  const Params& params;
  Samples& samples;
  RayCounts& rays;
  Work& work;
  Children& stack;           // empty between pixels
  Access* access = nullptr;  // is told what is read, unless null

  // Traces a pixel's shading tree, depth first, into the sample `at`.
  void trace(int x, int y, std::uint32_t at) {
    stack.push_back(make_primary(scene.view, params, x, y));
    while (!stack.empty()) {
      const Ray ray = stack.back();
      stack.pop_back();
      const auto hit = intersect(scene, ray, params.traversal, work, access);
      rays.add(ray.kind, hit.has_value());
      samples.add(at, eval_contribution(scene, params, ray, hit, work));
      if (hit) make_children(scene, params, ray, *hit, stack, work);
    }
  }
};

}  // namespace

void RayCounts::add(RayKind kind, bool hit) {
  primary += kind == RayKind::primary;
  primary_hit += kind == RayKind::primary && hit;
  reflected += kind == RayKind::reflected;
  transmitted += kind == RayKind::transmitted;
  shadow += kind == RayKind::shadow;
}

RayCounts& RayCounts::operator+=(const RayCounts& other) {
  primary += other.primary;
  primary_hit += other.primary_hit;
  reflected += other.reflected;
  transmitted += other.transmitted;
  shadow += other.shadow;
  return *this;
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
  block.rays = {};
  block.work = {};
  Tracer tracer{scene, params, block.samples, block.rays, block.work, buffer.pending, access};
  std::uint32_t at = 0;
  for (int y = area.y; y < area.y + area.height; ++y)
    for (int x = area.x; x < area.x + area.width; ++x) tracer.trace(x, y, at++);
}

void add_block(Samples& image, const Block& block, Work& work) {
  image.add(block.area.x, block.area.y, block.samples);
  work[Op::sample_updated] += block.samples.sums.size();
}

Rendering render(const Scene& scene, const Params& params, int threads, const Progress& progress) {
  check(params);
  require(threads >= 1 && threads <= MAX_THREADS, "threads", threads,
          fmt::format("1 to {}", MAX_THREADS));
  const Area area = get_area(params);
  Rendering result{Samples(params.width, params.height), {}, {}};
  // Rows are handed out one by one; an exception leaves none for the other threads.
  std::atomic<int> next = 0;
  std::mutex one_by_one;
  int done = 0;
  const auto trace_rows = [&] {
    RayCounts rays;
    Work work;
    Children stack;
    Tracer tracer{scene, params, result.samples, rays, work, stack};
    try {
      for (int row = next++; row < area.height; row = next++) {
        const int y = area.y + row;
        for (int x = area.x; x < area.x + area.width; ++x)
          tracer.trace(x, y, static_cast<std::uint32_t>(y * params.width + x));
        const std::lock_guard lock(one_by_one);
        ++done;
        if (progress) progress(done, area.height);
      }
    } catch (...) {
      next = area.height;
      throw;
    }
    const std::lock_guard lock(one_by_one);
    result.rays += rays;
    result.work += work;
  };
  std::vector<std::future<void>> helpers;
  for (int i = 1; i < std::min(threads, area.height); ++i)
    helpers.push_back(std::async(std::launch::async, trace_rows));
  trace_rows();
  for (auto& helper : helpers) helper.get();
  return result;
}

}  // namespace renderer
