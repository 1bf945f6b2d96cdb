#pragma once
// Progressive refinement of a picture with several samples a pixel, in two passes over the same
// order. The first takes one sample of every pixel, the second all others. No sample is taken
// twice, and the final picture is that of render().

#include "renderer/progressive/quadrants.hpp"
#include "renderer/trace/pixel_tracer.hpp"

namespace renderer::progressive {

/// Order of the traced pixels, and display of the others.
enum class Order : std::uint8_t {
  scan,      ///< row by row; a pixel is black until it is traced
  quadrants  ///< as QuadrantQueue; a pixel has the colour of its quadrant
};
/// The field "order" of P.
template <class P, class Access>
base::Field<P> order_field(Access access) {
  return base::Declare<P>::choice(
      "order", access, base::Names<Order>{{"scan", Order::scan}, {"quadrants", Order::quadrants}},
      "order of pixels: row by row, or quadrants of the picture from large to small");
}

/// The pixels of an area in an order, each with the rectangle that shows its colour.
class Walk {
 public:
  Walk(Order order, const Area& area);
  std::optional<Area> next();
  const QuadrantQueue* queue() const { return queue_ ? &*queue_ : nullptr; }

 private:
  Area area_;
  std::optional<QuadrantQueue> queue_;  // empty for Order::scan
  int column_ = 0, row_ = 0;
};

/// Progress and all results of a rendering. Vectors hold the area's pixels, row by row; unknown
/// entries are 0.
struct RefinementState {
  std::uint64_t done = 0;  ///< samples, see Refinement::done()
  std::vector<Samples::Sums> sums;
  std::vector<std::uint16_t> counts;   ///< of samples: 0, 1 or the pixel's total
  std::vector<std::uint32_t> objects;  ///< hit by the first samples; only with adaptive sampling
  CornerObjects corners;
  int corner_rows = 0;  ///< rows of `corners` that are known
  RayCounts rays;
  Work work;
};

class Refinement {
 public:
  /// `scene` must outlive it. BadInput as render().
  Refinement(const Scene& scene, const Params& params, Order order, int threads = 1);
  /// Continues from the state() of another one with equal scene, parameters and order. BadInput for
  /// a state of another size.
  Refinement(const Scene& scene, const Params& params, Order order, int threads,
             RefinementState state);

  /// Samples of the whole picture, `pixel_samples` for each pixel.
  std::uint64_t total() const { return pixels_ * pixel_samples(); }
  /// Samples taken. With adaptive sampling, a finished pixel counts as if it had all its samples.
  std::uint64_t done() const { return state_.done; }
  bool is_finished() const { return done() == total(); }
  /// Takes this many samples or a few more, as it takes all but a pixel's first sample together.
  /// The loop `while (r.done() < n) r.advance(n - r.done())` ends at the first pixel that reaches n
  /// samples, whatever the steps before and the number of threads.
  void advance(std::uint64_t samples);

  /// The picture so far. A pixel with one sample has that sample's colour.
  Rendering make_rendering() const;
  /// The same, but moves a finished picture out; the refinement cannot continue afterwards.
  Rendering take_rendering();
  const RefinementState& state() const { return state_; }
  /// Null unless the order is by quadrants.
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
  Walk walk_;                 // of the current pass
  std::vector<Pixel> batch_;  // the next pixels
};

}  // namespace renderer::progressive
