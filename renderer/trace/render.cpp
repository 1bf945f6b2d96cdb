#include "renderer/trace/render.hpp"

#include <atomic>
#include <future>
#include <mutex>

#include "renderer/scene/require.hpp"

namespace renderer {

namespace {

constexpr int MAX_THREADS = 1024;

// The objects at the corners of an area's pixels.
class CornerObjects {
 public:
  CornerObjects(const Params& params, const Area& area) : area_(area) {
    if (params.sampling.adaptive > 0)
      objects_.resize(columns() * (static_cast<std::size_t>(area.height) + 1));
  }
  /// Rows of corners: one more than of pixels, or none if nobody asks.
  int rows() const { return objects_.empty() ? 0 : area_.height + 1; }
  void find_row(int row, SampleTracer& tracer) {
    for (int column = 0; column <= area_.width; ++column)
      objects_[at(column, row)] = tracer.probe(area_.x + column, area_.y + row);
  }
  Corners of_pixel(int column, int row) const {
    return {objects_[at(column, row)], objects_[at(column + 1, row)], objects_[at(column, row + 1)],
            objects_[at(column + 1, row + 1)]};
  }

 private:
  std::size_t columns() const { return static_cast<std::size_t>(area_.width) + 1; }
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * columns() + static_cast<std::size_t>(column);
  }
  const Area area_;
  std::vector<std::uint32_t> objects_;
};

// All samples of the pixels of an area.
class PixelTracer {
 public:
  PixelTracer(const Params& params, const Area& area, const CornerObjects& corners,
              SampleTracer& tracer)
      : params_(params), area_(area), corners_(corners), tracer_(tracer) {}

  /// Returns the sums of the pixel's samples, and how many there were.
  std::pair<Samples::Sums, int> trace(int column, int row) {
    const Sampling& s = params_.sampling;
    const int x = area_.x + column, y = area_.y + row;
    if (!(s.adaptive > 0)) {
      Samples::Sums sums;
      for (int pass = 0; pass < s.pixel_samples; ++pass) add(sums, tracer_.trace(x, y, pass).sums);
      return {sums, s.pixel_samples};
    }
    samples_.clear();
    int has = 0;
    for (int wanted = first_round(s); has < wanted;
         wanted = find_wanted(s, samples_, corners_.of_pixel(column, row)))
      for (; has < wanted; ++has) samples_.push_back(tracer_.trace(x, y, has));
    return {eval_mean(add_up(samples_), has), has};
  }

 private:
  const Params& params_;
  const Area area_;
  const CornerObjects& corners_;
  SampleTracer& tracer_;
  std::vector<TracedSample> samples_;
};

// Calls work(row) for every row; the rows are handed out one by one. An exception leaves none for
// the other threads.
template <class Work>
void share_rows(int rows, int threads, const Work& work) {
  std::atomic<int> next = 0;
  const auto work_on_rows = [&] {
    try {
      for (int row = next++; row < rows; row = next++) work(row);
    } catch (...) {
      next = rows;
      throw;
    }
  };
  std::vector<std::future<void>> helpers;
  for (int i = 1; i < std::min(threads, rows); ++i)
    helpers.push_back(std::async(std::launch::async, work_on_rows));
  work_on_rows();
  for (auto& helper : helpers) helper.get();
}

}  // namespace

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
  block.counts.assign(params.sampling.adaptive > 0 ? block.samples.sums.size() : 0, 0);
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

Rendering render(const Scene& scene, const Params& params, int threads, const Progress& progress) {
  check(params);
  require(threads >= 1 && threads <= MAX_THREADS, "threads", threads,
          fmt::format("1 to {}", MAX_THREADS));
  const Area area = get_area(params);
  Rendering result{Samples(params.width, params.height), {}, {}, {}};
  if (params.sampling.adaptive > 0) result.counts.resize(result.samples.sums.size());
  std::mutex one_by_one;
  const auto add_counts = [&](const SampleTracer& tracer) {
    const std::lock_guard lock(one_by_one);
    result.rays += tracer.rays;
    result.work += tracer.work;
  };
  CornerObjects corners(params, area);
  share_rows(corners.rows(), threads, [&](int row) {
    SampleTracer tracer(scene, params);
    corners.find_row(row, tracer);
    add_counts(tracer);
  });
  int done = 0;
  share_rows(area.height, threads, [&](int row) {
    SampleTracer tracer(scene, params);
    PixelTracer pixels(params, area, corners, tracer);
    for (int column = 0; column < area.width; ++column) {
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
    if (progress) progress(done, area.height);
  });
  return result;
}

}  // namespace renderer
