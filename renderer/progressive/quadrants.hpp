#pragma once
// Pixel order of progressive refinement. A FIFO queue divides each quadrant of the picture into
// four. A quadrant has the colour of one of its pixels until its parts have theirs.

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

/// The computed pixel of a quadrant, at its lower left on the screen. The paper counts y upwards.
/// In a picture of H rows, its quadrant (x, y, w, h) is {x, H - y - h, w, h} here, and its pixel
/// (x, y) is (x, H - 1 - y).
inline Pixel own_pixel(const Area& quadrant) {
  return {quadrant.x, quadrant.y + quadrant.height - 1};
}

/// The queue of quadrants, which begins with the whole area. Each quadrant that leaves the queue is
/// divided into its upper left, lower right, upper right and lower left parts on the screen, as far
/// as they exist. Right and upper parts are the larger ones if a side is odd. Parts of more than a
/// pixel are queued, in this order. The lower left part has the own pixel of the whole: next()
/// returns only the other three, and thus every pixel once.
///
/// The queue holds at most max(1, N / 2) quadrants of an area of N pixels; N / 3 if it is a square,
/// N / 4 if its side is also a power of two.
class QuadrantQueue {
 public:
  /// The area of interest, 1 x 1 or larger.
  explicit QuadrantQueue(const Area& area);
  /// The next quadrant, to be filled with the colour of its own pixel. None after the last pixel.
  std::optional<Area> next();

  std::size_t length() const { return queue_.size(); }
  std::size_t peak() const { return peak_; }  ///< maximum length so far

 private:
  void enqueue(const Area& quadrant);
  void add(const Area& part);
  void divide(const Area& quadrant);

  std::deque<Area> queue_;
  std::size_t peak_ = 0;
  std::array<Area, 3> parts_;  // of the last quadrant divided, not yet returned
  std::size_t part_ = 0, part_count_ = 0;
};

/// The whole order: quadrants by rank, and the rank of each pixel of the area, row by row from the
/// top. A quadrant covers only lower ranks. If results arrive in another order, the quadrant of
/// highest rank over a pixel gives its colour.
struct QuadrantOrder {
  std::vector<Area> quadrants;
  std::vector<std::uint32_t> ranks;
};
QuadrantOrder make_order(const Area& area);

}  // namespace renderer::progressive
