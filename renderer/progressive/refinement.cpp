#include "renderer/progressive/refinement.hpp"

#include <mutex>

#include "base/share.hpp"
#include "renderer/scene/require.hpp"

namespace renderer::progressive {

namespace {

// Largest number of pixels in a batch, per thread, and in one part of a batch.
constexpr std::uint64_t MAX_BATCH = 1 << 12, MAX_PART = 256;

std::uint64_t divide_up(std::uint64_t a, std::uint64_t b) { return (a + b - 1) / b; }

RefinementState make_state(const Params& params) {
  const Area area = get_area(params);
  const auto pixels = static_cast<std::size_t>(area.width) * static_cast<std::size_t>(area.height);
  RefinementState state;
  state.sums.resize(pixels);
  state.counts.resize(pixels);
  if (is_adaptive(params.sampling)) state.objects.resize(pixels);
  state.corners = CornerObjects(params, area);
  return state;
}

const Params& checked(const Params& params, int threads) {
  check(params);
  check_threads(threads);
  return params;
}

}  // namespace

Walk::Walk(Order order, const Area& area) : area_(area) {
  if (order == Order::quadrants) queue_.emplace(area);
}

std::optional<Area> Walk::next() {
  if (queue_) return queue_->next();
  if (row_ == area_.height) return std::nullopt;
  const Area pixel{area_.x + column_, area_.y + row_, 1, 1};
  if (++column_ == area_.width) column_ = 0, ++row_;
  return pixel;
}

Refinement::Refinement(const Scene& scene, const Params& params, Order order, int threads)
    : Refinement(scene, params, order, threads, make_state(checked(params, threads))) {}

Refinement::Refinement(const Scene& scene, const Params& params, Order order, int threads,
                       RefinementState state)
    : scene_(scene),
      params_(checked(params, threads)),
      area_(get_area(params)),
      order_(order),
      threads_(threads),
      pixels_(static_cast<std::uint64_t>(area_.width) * static_cast<std::uint64_t>(area_.height)),
      state_(make_state(params)),
      walk_(order, area_) {
  const auto take = [](std::string_view name, auto& to, auto& from) {
    require(from.size() == to.size(), name, from.size(), fmt::format("{}", to.size()));
    to = std::move(from);
  };
  take("sums", state_.sums, state.sums);
  take("counts", state_.counts, state.counts);
  take("objects", state_.objects, state.objects);
  take("corners", state_.corners.objects, state.corners.objects);
  state_.done = state.done;
  state_.corner_rows = state.corner_rows;
  state_.rays = state.rays;
  state_.work = state.work;
  const std::uint64_t others = pixel_samples() - 1;
  require(done() <= total() && (done() <= pixels_ || (done() - pixels_) % others == 0), "samples",
          done(), fmt::format("at most {}, in complete pixels", total()));
  require(state_.corner_rows >= 0 && state_.corner_rows <= state_.corners.rows(), "corner_rows",
          state_.corner_rows, fmt::format("0 to {}", state_.corners.rows()));
  const auto begun = is_second_pass() && others > 0 ? (done() - pixels_) / others : done();
  for (std::uint64_t i = 0; i < begun; ++i) walk_.next();
}

void Refinement::advance(std::uint64_t samples) {
  for (std::uint64_t left = samples; left > 0 && !is_finished();) {
    const std::uint64_t before = done();
    std::uint64_t spent = 0;
    if (needs_corners()) {
      const auto rows = state_.corner_rows;
      find_corners(left);
      spent = static_cast<std::uint64_t>(state_.corner_rows - rows) *
              static_cast<std::uint64_t>(area_.width);
    } else {
      trace_pixels(divide_up(left, is_second_pass() ? pixel_samples() - 1 : 1));
      spent = done() - before;
    }
    left -= std::min(left, spent);
  }
}

std::size_t Refinement::find_index(const Pixel& pixel) const {
  return static_cast<std::size_t>(pixel.y - area_.y) * static_cast<std::size_t>(area_.width) +
         static_cast<std::size_t>(pixel.x - area_.x);
}

// Calls trace(part, tracer) for each part of a batch, in parallel. Adds up the counts of all
// tracers.
template <class Trace>
void Refinement::share_work(int parts, const Trace& trace) {
  std::mutex one_by_one;
  base::share(parts, threads_, [&](int part) {
    SampleTracer tracer(scene_, params_);
    trace(part, tracer);
    const std::lock_guard lock(one_by_one);
    state_.rays += tracer.rays;
    state_.work += tracer.work;
  });
}

void Refinement::find_corners(std::uint64_t samples) {
  const int rows = static_cast<int>(
      std::min(divide_up(samples, static_cast<std::uint64_t>(area_.width)),
               static_cast<std::uint64_t>(state_.corners.rows() - state_.corner_rows)));
  share_work(rows, [&](int row, SampleTracer& tracer) {
    state_.corners.find_row(state_.corner_rows + row, tracer);
  });
  state_.corner_rows += rows;
}

void Refinement::trace_pixels(std::uint64_t pixels) {
  batch_.clear();
  const auto most = std::min(pixels, MAX_BATCH * static_cast<std::uint64_t>(threads_));
  while (batch_.size() < most) {
    const auto block = walk_.next();
    if (!block) break;
    batch_.push_back(own_pixel(*block));
  }
  const std::size_t count = batch_.size();
  const std::size_t part =
      std::clamp<std::size_t>(count / (8 * static_cast<std::size_t>(threads_)), 1, MAX_PART);
  share_work(static_cast<int>(divide_up(count, part)), [&](int i, SampleTracer& tracer) {
    PixelTracer pixel_tracer(params_, area_, state_.corners, tracer);
    const std::size_t first = static_cast<std::size_t>(i) * part;
    for (std::size_t at = first; at < std::min(first + part, count); ++at)
      trace_pixel(batch_[at], pixel_tracer);
  });
  const bool was_first = !is_second_pass();
  state_.done += count * (was_first ? 1 : pixel_samples() - 1);
  if (was_first && is_second_pass() && !is_finished()) walk_ = Walk(order_, area_);
}

void Refinement::trace_pixel(const Pixel& pixel, PixelTracer& tracer) {
  const std::size_t at = find_index(pixel);
  const int column = pixel.x - area_.x, row = pixel.y - area_.y;
  const bool keeps_objects = !state_.objects.empty();
  if (state_.counts[at] == 0) {
    const TracedSample first = tracer.start(column, row);
    state_.sums[at] = first.sums;
    state_.counts[at] = 1;
    if (keeps_objects) state_.objects[at] = first.object;
    return;
  }
  const auto traced =
      tracer.finish(column, row, {state_.sums[at], keeps_objects ? state_.objects[at] : NO_OBJECT});
  state_.sums[at] = traced.sums;
  state_.counts[at] = static_cast<std::uint16_t>(traced.count);
}

Samples::Sums Refinement::find_shown(std::size_t index) const {
  const bool is_share = state_.counts[index] == 1 && !is_adaptive(params_.sampling);
  return is_share ? repeat(state_.sums[index], params_.sampling.pixel_samples) : state_.sums[index];
}

// Draws the rectangles of the first pass in the order of computation, each one over the earlier
// ones.
void Refinement::draw_blocks(Samples& picture) const {
  Walk walk(order_, area_);
  for (std::uint64_t i = 0; i < done(); ++i) {
    const Area block = *walk.next();
    const auto colour = find_shown(find_index(own_pixel(block)));
    for (int y = block.y; y < block.y + block.height; ++y)
      std::fill_n(
          &picture.sums[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                        static_cast<std::size_t>(block.x)],
          block.width, colour);
  }
}

Rendering Refinement::make_rendering() const {
  Rendering made{Samples(params_.width, params_.height), {}, state_.rays, state_.work};
  if (is_adaptive(params_.sampling)) made.counts.resize(made.samples.sums.size());
  std::size_t from = 0;
  for (int y = area_.y; y < area_.y + area_.height; ++y) {
    std::size_t to = static_cast<std::size_t>(y) * static_cast<std::size_t>(params_.width) +
                     static_cast<std::size_t>(area_.x);
    for (int column = 0; column < area_.width; ++column, ++from, ++to) {
      made.samples.sums[to] = find_shown(from);
      if (!made.counts.empty()) made.counts[to] = state_.counts[from];
    }
  }
  if (order_ == Order::quadrants && !is_second_pass()) draw_blocks(made.samples);
  return made;
}

Rendering Refinement::take_rendering() {
  if (!is_finished() || area_ != Area{0, 0, params_.width, params_.height}) return make_rendering();
  Rendering taken{{}, {}, state_.rays, state_.work};
  taken.samples.width = params_.width;
  taken.samples.height = params_.height;
  taken.samples.sums = std::move(state_.sums);
  if (is_adaptive(params_.sampling)) taken.counts = std::move(state_.counts);
  return taken;
}

}  // namespace renderer::progressive
