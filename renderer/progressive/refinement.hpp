#pragma once
// Progressive refinement of a picture with several samples per pixel, in two passes over the pixels
// in the same order. The first pass takes one sample of every pixel; the second takes all other
// samples. The final picture equals that of render().

#include "renderer/progressive/quadrants.hpp"
#include "renderer/trace/pixel_tracer.hpp"

namespace renderer::progressive {

/// The order in which pixels are traced, and the display of pixels that are not yet traced.
enum class Order : std::uint8_t {
  scan,      ///< row by row; pixels not yet traced are black
  quadrants  ///< in the order of QuadrantQueue; other pixels have the colour of their quadrant
};
/// Makes the field "order" of P, which selects an Order.
template <class P, class Access>
base::Field<P> order_field(Access access) {
  return base::Declare<P>::choice(
      "order", access, base::Names<Order>{{"scan", Order::scan}, {"quadrants", Order::quadrants}},
      "order of pixels: row by row, or quadrants of the picture from large to small");
}

/// Iterates over the pixels of an area in a given order. For each pixel, it also returns the
/// rectangle to be filled with the pixel's colour.
class Walk {
 public:
  Walk(Order order, const Area& area);
  std::optional<Area> next();
  const QuadrantQueue* queue() const { return queue_ ? &*queue_ : nullptr; }

 private:
  Area area_;
  std::optional<QuadrantQueue> queue_;  // quadrants still to be drawn; none for Order::scan
  int column_ = 0, row_ = 0;
};

/// Progress and results of a rendering. The vectors have one entry for each pixel of the area, row
/// by row from the top. Entries that are not yet known are 0.
struct RefinementState {
  std::uint64_t done = 0;  ///< number of samples taken (see Refinement::done())
  std::vector<Samples::Sums> sums;
  std::vector<std::uint16_t> counts;  ///< samples taken of each pixel: none, one or all
  /// By pixel: number of the object hit by the first sample. Only for adaptive sampling.
  std::vector<std::uint32_t> objects;
  CornerObjects corners;
  int corner_rows = 0;  ///< number of rows of `corners` that are complete
  RayCounts rays;
  Work work;
};

class Refinement {
 public:
  /// `scene` must outlive the object. Throws BadInput as render() does.
  Refinement(const Scene& scene, const Params& params, Order order, int threads = 1);
  /// Continues a refinement from its state(). The scene, parameters and order must be those of that
  /// refinement. Throws BadInput for a state of another size.
  Refinement(const Scene& scene, const Params& params, Order order, int threads,
             RefinementState state);

  /// Number of samples of the finished picture: pixel_samples() for each pixel.
  std::uint64_t total() const { return pixels_ * pixel_samples(); }
  /// Number of samples taken so far. With adaptive sampling, a finished pixel counts with
  /// pixel_samples() even if it needed fewer.
  std::uint64_t done() const { return state_.done; }
  bool is_finished() const { return done() == total(); }
  /// Takes this many samples, or a few more: after a pixel's first sample, all its other samples
  /// are taken together. The loop `while (r.done() < n) r.advance(n - r.done())` always ends at the
  /// first pixel that reaches n samples. It does not depend on earlier calls or the number of
  /// threads.
  void advance(std::uint64_t samples);

  /// The picture so far. A pixel with only one sample has the colour of that sample.
  Rendering make_rendering() const;
  /// Returns the finished picture by moving it. The refinement cannot continue afterwards.
  Rendering take_rendering();
  const RefinementState& state() const { return state_; }
  /// The queue of quadrants; null for Order::scan.
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
  Walk walk_;                 // position of the current pass in the order of pixels
  std::vector<Pixel> batch_;  // pixels to be traced next
};

}  // namespace renderer::progressive
