#include "renderer/trace/render.hpp"

#include <fmt/format.h>

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "base/errors.hpp"
#include "renderer/trace/shade.hpp"

namespace renderer {

namespace {

constexpr int MAX_THREADS = 1024;

// The state of one thread.
struct Tracer {
  const Scene& scene;
  const Params& params;
  Samples& samples;
  Access* access = nullptr;  // is told what is read, unless null
  RayCounts rays{};
  Work work{};
  Children stack{};

  // Traces a pixel's shading tree, depth first, into the sample `at`.
  void trace(int x, int y, std::uint32_t at) {
    stack.push_back(make_primary(scene.view, params, x, y));
    while (!stack.empty()) {
      const Ray ray = stack.back();
      stack.pop_back();
      const std::optional<Hit> hit = access ? intersect(scene, ray, params.traversal, work, *access)
                                            : intersect(scene, ray, params.traversal, work);
      rays.add(ray.kind, hit.has_value());
      samples.add(at, eval_contribution(scene, params, ray, hit, work));
      if (hit) make_children(scene, params, ray, *hit, stack, work);
    }
  }
};

// Rows are handed out one by one; the first exception stops every thread.
class Rows {
 public:
  Rows(int rows, const Progress& progress) : rows_(rows), progress_(progress) {}

  /// The next row, or the number of rows when there is none left.
  int take() { return stopped_ ? rows_ : std::min(next_++, rows_); }

  void report() {
    const std::lock_guard lock(mutex_);
    ++done_;
    if (progress_) progress_(done_, rows_);
  }

  void stop() {
    const std::lock_guard lock(mutex_);
    if (!error_) error_ = std::current_exception();
    stopped_ = true;
  }

  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  const int rows_;
  const Progress& progress_;
  std::atomic<int> next_ = 0;
  std::atomic<bool> stopped_ = false;
  std::mutex mutex_;
  int done_ = 0;
  std::exception_ptr error_;
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

namespace {

Block render_pixels(const Scene& scene, const Params& params, const Area& area, Access* access) {
  Block block{area, Samples(area.width, area.height), {}, {}};
  Tracer tracer{scene, params, block.samples, access};
  std::uint32_t at = 0;
  for (int y = area.y; y < area.y + area.height; ++y)
    for (int x = area.x; x < area.x + area.width; ++x) tracer.trace(x, y, at++);
  block.rays = tracer.rays;
  block.work = tracer.work;
  return block;
}

}  // namespace

Block render_block(const Scene& scene, const Params& params, const Area& area) {
  return render_pixels(scene, params, area, nullptr);
}

Block render_block(const Scene& scene, const Params& params, const Area& area, Access& access) {
  return render_pixels(scene, params, area, &access);
}

Rendering render(const Scene& scene, const Params& params, int threads, const Progress& progress) {
  check(params);
  if (threads < 1 || threads > MAX_THREADS)
    throw base::BadInput(fmt::format("threads: found {}, expected 1 to {}", threads, MAX_THREADS));
  const Area area = get_area(params);
  Rendering result{Samples(params.width, params.height), {}, {}};
  Rows rows(area.height, progress);
  std::mutex gather;

  const auto work_on_rows = [&] {
    Tracer tracer{scene, params, result.samples};
    try {
      for (int row = rows.take(); row < area.height; row = rows.take()) {
        for (int x = area.x; x < area.x + area.width; ++x)
          tracer.trace(x, area.y + row,
                       static_cast<std::uint32_t>((area.y + row) * params.width + x));
        rows.report();
      }
    } catch (...) {
      rows.stop();
    }
    const std::lock_guard lock(gather);
    result.rays += tracer.rays;
    result.work += tracer.work;
  };
  {
    std::vector<std::jthread> helpers;
    for (int i = 1; i < std::min(threads, area.height); ++i) helpers.emplace_back(work_on_rows);
    work_on_rows();
  }
  rows.rethrow();
  return result;
}

}  // namespace renderer
