#pragma once
// Progressive refinement of a picture with several samples per pixel. Two passes have the same
// order: the first takes one sample of every pixel, the second all others. No sample is taken
// twice, and the final picture equals that of render().

#include "renderer/progressive/quadrants.hpp"
#include "renderer/trace/pixel_tracer.hpp"

namespace renderer::progressive {

/// Order in which pixels are traced, and display of untraced pixels.
enum class Order : std::uint8_t {
  scan,      ///< row by row; untraced pixels are black
  quadrants  ///< in the order of QuadrantQueue; untraced pixels have the colour of their quadrant
};
/// Makes the field "order" of P.
template <class P, class Access>
base::Field<P> order_field(Access access) {
  return base::Declare<P>::choice(
      "order", access, base::Names<Order>{{"scan", Order::scan}, {"quadrants", Order::quadrants}},
      "order of pixels: row by row, or quadrants of the picture from large to small");
}

/// Iterator over the pixels of an area in a given order. For each pixel it returns the rectangle to
/// fill with the pixel's colour.
class Walk {
 public:
  Walk(Order order, const Area& area);
  std::optional<Area> next();
  const QuadrantQueue* queue() const { return queue_ ? &*queue_ : nullptr; }

 private:
  Area area_;
  std::optional<QuadrantQueue> queue_;  // the quadrants still to be drawn; none for Order::scan
  int column_ = 0, row_ = 0;
};

/// Progress and results of a rendering. Vectors have one entry for each pixel of the area, row by
/// row; entries that are not known yet are 0.
struct RefinementState {
  std::uint64_t done = 0;  ///< number of samples taken (see Refinement::done())
  std::vector<Samples::Sums> sums;
  std::vector<std::uint16_t> counts;  ///< number of samples of each pixel: 0, 1 or all of them
  /// objects hit by the first samples; only with adaptive sampling
  std::vector<std::uint32_t> objects;
  CornerObjects corners;
  int corner_rows = 0;  ///< number of rows of `corners` that have been traced
  RayCounts rays;
  Work work;
};

class Refinement {
 public:
  /// `scene` must outlive the object. Throws BadInput as render() does.
  Refinement(const Scene& scene, const Params& params, Order order, int threads = 1);
  /// Continues from the state() of a refinement with equal scene, parameters and order. Throws
  /// BadInput for a state of another size.
  Refinement(const Scene& scene, const Params& params, Order order, int threads,
             RefinementState state);

  /// Number of samples of the whole picture, `pixel_samples` for each pixel.
  std::uint64_t total() const { return pixels_ * pixel_samples(); }
  /// Number of samples taken. With adaptive sampling, a finished pixel counts as if it had all its
  /// samples.
  std::uint64_t done() const { return state_.done; }
  bool is_finished() const { return done() == total(); }
  /// Takes this many samples, or a few more, since all samples of a pixel after its first are taken
  /// together. The loop `while (r.done() < n) r.advance(n - r.done())` ends at the first pixel that
  /// reaches n samples, whatever the earlier steps and the number of threads.
  void advance(std::uint64_t samples);

  /// The picture so far. A pixel with one sample has that sample's colour.
  Rendering make_rendering() const;
  /// Moves the finished picture out. The refinement cannot continue afterwards.
  Rendering take_rendering();
  const RefinementState& state() const { return state_; }
  /// The queue; null unless the order is by quadrants.
  const QuadrantQueue* queue() const { return walk_.queue(); }

 private:
  std::uint64_t pixel_samples() const {
    return static_cast<std::uint64_t>(params_.sampling.pixel_samples);
  }
  bool is_second_pass() const { return done() >= pixels_; }
  bool needs_corners() const {
    return is_second_pass() && state_.corner_rows < state_.corners.rows();
  }
  std::size_t find_index(const Pixel& pixel) const;
  void find_corners(std::uint64_t samples);
  void trace_pixels(std::uint64_t pixels);
  template <class Trace>
  void share_work(int parts, const Trace& trace);
  void trace_pixel(const Pixel& pixel, PixelTracer& tracer);
  Samples::Sums find_shown(std::size_t index) const;
  void draw_blocks(Samples& picture) const;

  const Scene& scene_;
  const Params params_;
  const Area area_;
  const Order order_;
  const int threads_;
  const std::uint64_t pixels_;
  RefinementState state_;
  Walk walk_;                 // position of the current pass in the pixel order
  std::vector<Pixel> batch_;  // next pixels to trace
};

}  // namespace renderer::progressive
