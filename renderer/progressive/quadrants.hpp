#pragma once
// Pixel order of progressive refinement. A FIFO queue divides each quadrant, a rectangle of the
// picture, into four. A quadrant is shown in the colour of one of its pixels until its parts are
// computed.

#include <array>
#include <cstddef>
#include <deque>
#include <optional>

#include "renderer/trace/params.hpp"

namespace renderer::progressive {

struct Pixel {
  int x = 0, y = 0;
  bool operator==(const Pixel&) const = default;
};

/// The pixel that gives a quadrant its colour: the lower left pixel on the screen. The paper counts
/// y upwards. In a picture of H rows, the paper's quadrant (x, y, w, h) is {x, H - y - h, w, h}
/// here, and its pixel (x, y) is (x, H - 1 - y).
inline Pixel own_pixel(const Area& quadrant) {
  return {quadrant.x, quadrant.y + quadrant.height - 1};
}

/// A queue of quadrants, which at first contains only the whole area. Each quadrant that leaves the
/// queue is divided into its upper left, lower right, upper right and lower left parts on the
/// screen, if they exist. If a side has an odd length, the right or upper parts are the larger
/// ones. Parts of more than one pixel join the queue in this order. The lower left part has the
/// same computed pixel as the whole quadrant. next() therefore returns only the other three parts,
/// and returns each pixel once.
///
/// For an area of N pixels, the queue holds at most max(1, N / 2) quadrants. For a square, the
/// maximum is N / 3, or N / 4 if the side is a power of two.
class QuadrantQueue {
 public:
  /// Starts with the area of interest, which must have at least one pixel.
  explicit QuadrantQueue(const Area& area);
  /// Returns the next quadrant, to be filled with the colour of its own_pixel(). Returns none after
  /// the last pixel.
  std::optional<Area> next();

  std::size_t length() const { return queue_.size(); }
  std::size_t peak() const { return peak_; }  ///< maximum length of the queue so far

 private:
  void enqueue(const Area& quadrant);
  void add(const Area& part);
  void divide(const Area& quadrant);

  std::deque<Area> queue_;
  std::size_t peak_ = 0;
  std::array<Area, 3> parts_;  // parts of the last quadrant that next() has not yet returned
  std::size_t part_ = 0, part_count_ = 0;
};

/// The complete order. The rank of a quadrant is its index in `quadrants`. The rank of a pixel is
/// that of the quadrant whose colour it computes; pixels are stored row by row from the top. A
/// quadrant covers its own pixel and pixels of later ranks. If results arrive out of order, a pixel
/// takes its colour from the quadrant with the latest rank that covers it.
struct QuadrantOrder {
  std::vector<Area> quadrants;
  std::vector<std::uint32_t> ranks;
};
QuadrantOrder make_order(const Area& area);

}  // namespace renderer::progressive
