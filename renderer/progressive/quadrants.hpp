#pragma once
// Pixel order of progressive refinement. A FIFO queue divides each quadrant of the picture into
// four. A quadrant has the colour of one of its pixels until its parts are computed.

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

/// The computed pixel of a quadrant: the lower left one on the screen. The paper counts y upwards:
/// in a picture of H rows, the paper's quadrant (x, y, w, h) is {x, H - y - h, w, h} here, and the
/// paper's pixel (x, y) is (x, H - 1 - y).
inline Pixel own_pixel(const Area& quadrant) {
  return {quadrant.x, quadrant.y + quadrant.height - 1};
}

/// Queue of quadrants, which begins with the whole area. Each quadrant that leaves the queue is
/// divided into its upper left, lower right, upper right and lower left parts on the screen, as far
/// as they exist. If a side is odd, the right and upper parts are the larger ones. Parts of more
/// than one pixel are queued in this order. The lower left part has the same computed pixel as the
/// whole quadrant. next() therefore returns only the three other parts, and each pixel once.
///
/// The queue holds at most max(1, N / 2) quadrants for an area of N pixels. The maximum is N / 3
/// for a square, and N / 4 if its side is also a power of two.
class QuadrantQueue {
 public:
  /// Starts with the area of interest, 1 x 1 or larger.
  explicit QuadrantQueue(const Area& area);
  /// The next quadrant, to be filled with the colour of its computed pixel; none after the last
  /// pixel.
  std::optional<Area> next();

  std::size_t length() const { return queue_.size(); }
  std::size_t peak() const { return peak_; }  ///< maximum length of the queue so far

 private:
  void enqueue(const Area& quadrant);
  void add(const Area& part);
  void divide(const Area& quadrant);

  std::deque<Area> queue_;
  std::size_t peak_ = 0;
  std::array<Area, 3> parts_;  // parts of the last quadrant that have not been returned
  std::size_t part_ = 0, part_count_ = 0;
};

/// The complete order: quadrants by rank, and the rank of each pixel of the area, row by row from
/// the top. A quadrant covers its own pixel and pixels of later ranks. If results arrive out of
/// order, a pixel takes its colour from the quadrant with the latest rank that covers it.
struct QuadrantOrder {
  std::vector<Area> quadrants;
  std::vector<std::uint32_t> ranks;
};
QuadrantOrder make_order(const Area& area);

}  // namespace renderer::progressive
