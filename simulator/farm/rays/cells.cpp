#include "simulator/farm/rays/cells.hpp"

#include <algorithm>
#include <bit>
#include <tuple>

#include "base/random.hpp"

namespace farm {

using renderer::Area;
using renderer::Op;
using renderer::Rgb;

namespace {

struct Pixel {
  int x, y;
};

Pixel pixel_of(std::uint32_t sample, int width) {
  const int s = static_cast<int>(sample);
  return {s % width, s / width};
}

bool contains(const Area& area, Pixel p) {
  return p.x >= area.x && p.x < area.x + area.width && p.y >= area.y && p.y < area.y + area.height;
}

int log2_of(int size) { return std::countr_zero(static_cast<unsigned>(size)); }

}  // namespace

std::uint32_t Cells::rank_of(std::uint32_t sample) const {
  const auto p = pixel_of(sample, width);
  const Area& all = quadrants->quadrants[0];
  return quadrants
      ->ranks[static_cast<std::size_t>(p.y - all.y) * static_cast<std::size_t>(all.width) +
              static_cast<std::size_t>(p.x - all.x)];
}

std::uint32_t Cells::fineness_of(std::uint32_t sample) const {
  if (quadrants) return static_cast<std::uint32_t>(quadrants->ranks.size()) - 1 - rank_of(sample);
  return static_cast<std::uint32_t>(log2_of(size_of(sample)));
}

int Cells::size_of(std::uint32_t sample) const {
  if (quadrants) return 1;
  const auto p = pixel_of(sample, width);
  const auto corner = static_cast<unsigned>((p.x - x) | (p.y - y) | max_cell);
  return 1 << std::countr_zero(corner);
}

std::uint64_t Cells::place_of(std::uint32_t sample) const {
  if (quadrants) return rank_of(sample);
  if (order == CellOrder::sequential) return sample;
  if (order != CellOrder::recursive) return 0;
  const auto p = pixel_of(sample, width);
  std::uint64_t place = 0;  // the bits of x and y, interleaved (Z-order curve)
  for (int bit = 0; bit < 17; ++bit) {
    place |= static_cast<std::uint64_t>((p.x - x) >> bit & 1) << (2 * bit);
    place |= static_cast<std::uint64_t>((p.y - y) >> bit & 1) << (2 * bit + 1);
  }
  return place;
}

Area Cells::area_of(std::uint32_t sample, const Area& limit) const {
  const auto p = pixel_of(sample, width);
  const int size = size_of(sample);
  const Area cell = quadrants ? quadrants->quadrants[rank_of(sample)] : Area{p.x, p.y, size, size};
  const int left = std::max(cell.x, limit.x), top = std::max(cell.y, limit.y);
  const int right = std::min(cell.x + cell.width, limit.x + limit.width);
  const int bottom = std::min(cell.y + cell.height, limit.y + limit.height);
  return {left, top, std::max(0, right - left), std::max(0, bottom - top)};
}

std::vector<std::uint32_t> Cells::divide(std::uint32_t sample, const Area& limit) const {
  const auto p = pixel_of(sample, width);
  std::vector<std::uint32_t> samples;
  for (int s = size_of(sample) / 2; s >= 1; s /= 2)
    for (const Pixel q : {Pixel{p.x + s, p.y}, Pixel{p.x, p.y + s}, Pixel{p.x + s, p.y + s}})
      if (contains(limit, q)) samples.push_back(static_cast<std::uint32_t>(q.y * width + q.x));
  return samples;
}

std::vector<renderer::Ray> make_initial_rays(const renderer::Scene& scene,
                                             const renderer::Params& params, const Cells& cells,
                                             std::uint64_t seed) {
  const Area area = renderer::get_area(params);
  using Key = std::tuple<int, std::uint64_t, std::uint64_t, std::uint32_t>;
  std::vector<Key> order;  // sort keys: -size, place, random number, sample
  for (int y = area.y; y < area.y + area.height; ++y)
    for (int x = area.x; x < area.x + area.width; ++x) {
      const auto sample = static_cast<std::uint32_t>(y * params.width + x);
      const int size = cells.size_of(sample);
      if (cells.order == CellOrder::adaptive && size < cells.max_cell) continue;
      order.emplace_back(-size, cells.place_of(sample), base::random_at(seed, sample), sample);
    }
  std::ranges::sort(order);
  std::vector<renderer::Ray> rays;
  rays.reserve(order.size());
  for (const Key& key : order) {
    const auto p = pixel_of(std::get<3>(key), params.width);
    rays.push_back(renderer::make_primary(scene.view, params, p.x, p.y));
  }
  return rays;
}

FrameBuffer::FrameBuffer(int width, int height, Cells cells, CellLight light, Area area,
                         const renderer::Sampling& sampling)
    : cells_(cells),
      light_(light),
      width_(width),
      area_(area == Area{} ? Area{0, 0, width, height} : area),
      sampling_(sampling),
      samples_(width, height),
      counts_(sampling.pixel_samples > 1 ? samples_.sums.size() : 0),
      owner_(samples_.sums.size(), NOBODY),
      rgb8_(3 * samples_.sums.size()) {}

renderer::Samples FrameBuffer::samples() const {
  renderer::Samples means = samples_;
  for (std::size_t i = 0; i < counts_.size(); ++i)
    means.sums[i] = eval_final(sampling_, means.sums[i], counts_[i]);
  return means;
}

Rgb FrameBuffer::colour_of(std::uint32_t sample) const {
  return eval_shown(sampling_, samples_.sums[sample], counts_.empty() ? 1 : counts_[sample]);
}

bool FrameBuffer::add(const renderer::Ray& ray, const Rgb& contribution, renderer::Work& work) {
  const std::uint32_t sample = ray.sample;
  samples_.add(sample, contribution);
  if (!counts_.empty() && ray.level == 1) ++counts_[sample];
  own(sample);
  return paint_all(sample, work);
}

void FrameBuffer::finish(const FinishedPixel& finished, renderer::Work& work) {
  samples_.sums[finished.sample] = finished.sums;
  work[Op::sample_updated] += 1;
  paint_all(finished.sample, work);
}

bool FrameBuffer::paint_all(std::uint32_t sample, renderer::Work& work) {
  bool changed = paint(sample, work);
  if (light_ == CellLight::smooth) changed |= paint_neighbours(sample, work);
  return changed;
}

void FrameBuffer::add(const renderer::Block& block, renderer::Work& work) {
  add_block(samples_, block, work);
  work[Op::pixel_drawn] += block.samples.sums.size();
  const Area& area = block.area;
  for (int y = area.y; y < area.y + area.height; ++y)
    for (int x = area.x; x < area.x + area.width; ++x) {
      const auto pixel = static_cast<std::uint32_t>(y * width_ + x);
      owner_[pixel] = 0;
      draw(pixel, make_rgb8(samples_, pixel));
    }
}

// True if the sample's pixel shows the sample's own cell or a smaller one.
bool FrameBuffer::is_sampled(std::uint32_t sample) const {
  return owner_[sample] <= cells_.fineness_of(sample);
}

// Side in pixels of the part of the sample's cell that no smaller sampled cell has taken over. A
// cell halves when the samples of its other three quarters have arrived.
int FrameBuffer::size_now(std::uint32_t sample) const {
  const auto p = pixel_of(sample, width_);
  const auto is_done = [&](int x, int y) {
    return !contains(area_, {x, y}) || is_sampled(static_cast<std::uint32_t>(y * width_ + x));
  };
  int size = cells_.size_of(sample);
  for (; size > 1; size /= 2) {
    const int s = size / 2;
    if (!is_done(p.x + s, p.y) || !is_done(p.x, p.y + s) || !is_done(p.x + s, p.y + s)) break;
  }
  return size;
}

// Makes the sample's cell the owner of its pixels, except of pixels owned by a smaller cell.
void FrameBuffer::own(std::uint32_t sample) {
  if (is_sampled(sample)) return;
  const auto fineness = cells_.fineness_of(sample);
  const Area cell = cells_.area_of(sample, area_);
  for (int y = cell.y; y < cell.y + cell.height; ++y)
    for (int x = cell.x; x < cell.x + cell.width; ++x) {
      auto& owner = owner_[static_cast<std::size_t>(y * width_ + x)];
      owner = std::min(owner, fineness);
    }
}

// Paints the pixels that the sample's cell owns. They are the pixels in its square that have its
// fineness, because cells of equal size do not overlap.
bool FrameBuffer::paint(std::uint32_t sample, renderer::Work& work) {
  bool changed = false;
  const auto colour = renderer::make_rgb8(colour_of(sample));
  if (light_ == CellLight::point) {
    ++work[Op::pixel_drawn];
    return draw(sample, colour);
  }
  const auto fineness = cells_.fineness_of(sample);
  const bool is_one_colour = light_ == CellLight::constant || size_now(sample) == 1;
  const Area cell = cells_.area_of(sample, area_);
  for (int y = cell.y; y < cell.y + cell.height; ++y)
    for (int x = cell.x; x < cell.x + cell.width; ++x) {
      const auto pixel = static_cast<std::size_t>(y * width_ + x);
      if (owner_[pixel] != fineness) continue;
      ++work[Op::pixel_drawn];
      if (is_one_colour) {
        changed |= draw(pixel, colour);
      } else {
        ++work[Op::pixel_interpolated];
        changed |= draw(pixel, renderer::make_rgb8(eval_smooth(sample, x, y)));
      }
    }
  return changed;
}

// Repaints the cells that have this sample at their upper right, lower left or lower right corner.
bool FrameBuffer::paint_neighbours(std::uint32_t sample, renderer::Work& work) {
  bool changed = false;
  const auto p = pixel_of(sample, width_);
  for (int s = 1; s <= cells_.max_cell; s *= 2)
    for (const Pixel q : {Pixel{p.x - s, p.y}, Pixel{p.x, p.y - s}, Pixel{p.x - s, p.y - s}}) {
      if (!contains(area_, q)) continue;
      const auto other = static_cast<std::uint32_t>(q.y * width_ + q.x);
      if (is_sampled(other) && size_now(other) <= s) changed |= paint(other, work);
    }
  return changed;
}

// Interpolates the colour at pixel (x, y) bilinearly between the corners of the sample's cell.
// Corners without a sample take the colour of `sample`.
Rgb FrameBuffer::eval_smooth(std::uint32_t sample, int x, int y) const {
  const auto p = pixel_of(sample, width_);
  const int size = size_now(sample);
  const Rgb own = colour_of(sample);
  const auto corner = [&](int cx, int cy) {
    if (!contains(area_, {cx, cy})) return own;
    const auto other = static_cast<std::uint32_t>(cy * width_ + cx);
    return is_sampled(other) ? colour_of(other) : own;
  };
  const double u = static_cast<double>(x - p.x) / size, v = static_cast<double>(y - p.y) / size;
  const Rgb top = (1 - u) * own + u * corner(p.x + size, p.y);
  const Rgb bottom = (1 - u) * corner(p.x, p.y + size) + u * corner(p.x + size, p.y + size);
  return (1 - v) * top + v * bottom;
}

bool FrameBuffer::draw(std::size_t pixel, const std::array<std::uint8_t, 3>& colour) {
  const auto at = rgb8_.begin() + static_cast<std::ptrdiff_t>(3 * pixel);
  if (std::ranges::equal(colour, std::span(at, 3))) return false;
  std::ranges::copy(colour, at);
  return true;
}

}  // namespace farm
