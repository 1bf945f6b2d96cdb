#pragma once
// The order of the pixels in progressive refinement: each quadrant of the picture is divided into
// four, first in, first out, and has the colour of one of its pixels until its parts have theirs.

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

/// The pixel of a quadrant that is computed, at its lower left on the screen. The paper counts y
/// upwards, so that its quadrant (x, y, w, h) of a picture of H rows is here {x, H - y - h, w, h},
/// and its pixel (x, y) is here (x, H - 1 - y).
inline Pixel own_pixel(const Area& quadrant) {
  return {quadrant.x, quadrant.y + quadrant.height - 1};
}

/// The queue of quadrants. The first quadrant is the whole area. Each one that leaves the queue is
/// divided into its upper left, lower right, upper right and lower left part on the screen, those
/// that there are; right and upper parts are the larger ones where a side is odd. Parts of more
/// than a pixel are queued, in this order. The own pixel of the lower left part is that of the
/// whole, so that only the three others are handed out, and every pixel is handed out once.
///
/// The queue holds at most max(1, N / 2) quadrants of an area of N pixels; N / 3 if it is a square,
/// N / 4 if it is a square whose side is a power of two.
class QuadrantQueue {
 public:
  /// The area of interest, 1 x 1 or larger.
  explicit QuadrantQueue(const Area& area);
  /// The next quadrant: its own pixel's colour is drawn over all of it. None after the last pixel.
  std::optional<Area> next();

  std::size_t length() const { return queue_.size(); }
  std::size_t peak() const { return peak_; }  ///< the greatest length until now

 private:
  void enqueue(const Area& quadrant);
  void add(const Area& part);
  void divide(const Area& quadrant);

  std::deque<Area> queue_;
  std::size_t peak_ = 0;
  std::array<Area, 3> parts_;  // of the last quadrant divided, which have not been handed out
  std::size_t part_ = 0, part_count_ = 0;
};

/// The whole order: quadrants by their rank, and the rank of each pixel of the area, row by row
/// from the top. A quadrant covers those of lower ranks only: when results arrive in another order,
/// a pixel's colour is that of the quadrant of highest rank that lies over it.
struct QuadrantOrder {
  std::vector<Area> quadrants;
  std::vector<std::uint32_t> ranks;
};
QuadrantOrder make_order(const Area& area);

}  // namespace renderer::progressive
