#pragma once
// Traces all samples of a pixel one after the other, for pixels in any order.

#include "renderer/trace/render.hpp"

namespace renderer {

/// The objects at the corners of an area's pixels, for adaptive sampling.
class CornerObjects {
 public:
  CornerObjects() = default;
  CornerObjects(const Params& params, const Area& area);

  /// Number of rows of corners: one more than there are rows of pixels, or 0 without adaptive
  /// sampling.
  int rows() const { return objects.empty() ? 0 : area_.height + 1; }
  void find_row(int row, SampleTracer& tracer);
  /// The objects at the corners of a pixel. find_row() must have been called for all rows.
  Corners of_pixel(int column, int row) const {
    return {objects[at(column, row)], objects[at(column + 1, row)], objects[at(column, row + 1)],
            objects[at(column + 1, row + 1)]};
  }

  std::vector<std::uint32_t> objects;  ///< by corner, row by row

 private:
  std::size_t columns() const { return static_cast<std::size_t>(area_.width) + 1; }
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * columns() + static_cast<std::size_t>(column);
  }
  Area area_;
};

/// Result of one pixel.
struct TracedPixel {
  Samples::Sums sums;  ///< sums as in the final image
  int count = 0;       ///< number of samples
};

/// Traces the pixels of an area. Columns and rows count from 0 at the area's upper left pixel.
class PixelTracer {
 public:
  PixelTracer(const Params& params, const Area& area, const CornerObjects& corners,
              SampleTracer& tracer)
      : params_(params), area_(area), corners_(corners), tracer_(tracer) {}

  /// Traces the first sample of a pixel.
  TracedSample start(int column, int row) {
    return tracer_.trace(area_.x + column, area_.y + row, 0);
  }
  /// Traces all samples except `first`, and returns the result of all samples.
  TracedPixel finish(int column, int row, const TracedSample& first);
  /// Traces all samples of a pixel.
  TracedPixel trace(int column, int row) { return finish(column, row, start(column, row)); }

 private:
  const Params& params_;
  const Area area_;
  const CornerObjects& corners_;
  SampleTracer& tracer_;
  std::vector<TracedSample> samples_;
};

}  // namespace renderer
