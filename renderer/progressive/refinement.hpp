#pragma once
// Progressive refinement of a picture of several samples a pixel, in two passes: the first takes
// one sample of every pixel, the second all the others, in the same order of pixels. No sample is
// taken twice, and the picture at the end is render()'s.

#include "renderer/progressive/quadrants.hpp"
#include "renderer/trace/pixel_tracer.hpp"

namespace renderer::progressive {

/// In which order pixels are traced, and what is shown of those that are not.
enum class Order : std::uint8_t {
  scan,      ///< row by row; a pixel is black until it is traced
  quadrants  ///< as QuadrantQueue; a pixel has the colour of the quadrant that it lies in
};
/// The field "order" of P.
template <class P, class Access>
base::Field<P> order_field(Access access) {
  return base::Declare<P>::choice(
      "order", access, base::Names<Order>{{"scan", Order::scan}, {"quadrants", Order::quadrants}},
      "order of pixels: row by row, or quadrants of the picture from large to small");
}

/// The pixels of an area in an order, each as the rectangle that its colour is drawn over.
class Walk {
 public:
  Walk(Order order, const Area& area);
  std::optional<Area> next();
  const QuadrantQueue* queue() const { return queue_ ? &*queue_ : nullptr; }

 private:
  Area area_;
  std::optional<QuadrantQueue> queue_;  // unless the order is scan
  int column_ = 0, row_ = 0;
};

/// How far a rendering is, and all that has been found. Vectors are of the area's pixels, row by
/// row; what is not known yet is 0.
struct RefinementState {
  std::uint64_t done = 0;  ///< samples, see Refinement::done()
  std::vector<Samples::Sums> sums;
  std::vector<std::uint16_t> counts;   ///< of samples: 0, 1 or all that the pixel gets
  std::vector<std::uint32_t> objects;  ///< that the first samples meet; only with adaptive sampling
  CornerObjects corners;
  int corner_rows = 0;  ///< rows of `corners` that are known
  RayCounts rays;
  Work work;
};

class Refinement {
 public:
  /// `scene` must outlive it. BadInput as render().
  Refinement(const Scene& scene, const Params& params, Order order, int threads = 1);
  /// Goes on from the state() of another one with equal scene, parameters and order. BadInput for a
  /// state of another size.
  Refinement(const Scene& scene, const Params& params, Order order, int threads,
             RefinementState state);

  /// Samples of the whole picture, `pixel_samples` for each pixel.
  std::uint64_t total() const { return pixels_ * pixel_samples(); }
  /// Samples taken. With adaptive sampling, a pixel that is finished counts as if it had had all.
  std::uint64_t done() const { return state_.done; }
  bool is_finished() const { return done() == total(); }
  /// Does the work of as many samples, or little more: of a pixel the first sample alone, then all
  /// the others together. `while (r.done() < n) r.advance(n - r.done())` ends at the first pixel
  /// with which there are n samples, whatever the steps before and the number of threads.
  void advance(std::uint64_t samples);

  /// The picture so far. A pixel with one sample has that sample's colour.
  Rendering make_rendering() const;
  /// The same without a copy of a finished picture; afterwards there is nothing left to go on with.
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
  Walk walk_;                 // of the present pass
  std::vector<Pixel> batch_;  // the next pixels
};

}  // namespace renderer::progressive
