#include "renderer/progressive/quadrants.hpp"

#include "renderer/scene/require.hpp"

namespace renderer::progressive {

QuadrantQueue::QuadrantQueue(const Area& area) {
  require(area.width > 0 && area.height > 0, "area",
          fmt::format("{} x {}", area.width, area.height), "a width and a height above zero");
  enqueue(area);
  add(area);
}

std::optional<Area> QuadrantQueue::next() {
  while (part_ == part_count_) {
    if (queue_.empty()) return std::nullopt;
    const Area first = queue_.front();
    queue_.pop_front();
    divide(first);
  }
  return parts_[part_++];
}

void QuadrantQueue::enqueue(const Area& quadrant) {
  if (quadrant.width == 1 && quadrant.height == 1) return;
  queue_.push_back(quadrant);
  peak_ = std::max(peak_, queue_.size());
}

void QuadrantQueue::add(const Area& part) { parts_[part_count_++] = part; }

// Divides a quadrant. The names are those of the paper's listing: w1 and w2 are the widths of the
// left and right parts, h1 and h2 are the heights of the lower and upper parts. A quadrant of one
// column has no right parts, and a quadrant of one row has no upper parts.
void QuadrantQueue::divide(const Area& q) {
  part_ = part_count_ = 0;
  const bool has_right = q.width > 1, has_upper = q.height > 1;
  const int w1 = has_right ? q.width / 2 : 1, h1 = has_upper ? q.height / 2 : 1;
  const int w2 = q.width - w1, h2 = q.height - h1;
  const auto take = [&](const Area& part) {
    enqueue(part);
    add(part);
  };
  if (has_upper) take({q.x, q.y, w1, h2});
  if (has_right) take({q.x + w1, q.y + h2, w2, h1});
  if (has_right && has_upper) take({q.x + w1, q.y, w2, h2});
  enqueue({q.x, q.y + h2, w1, h1});
}

QuadrantOrder make_order(const Area& area) {
  QuadrantQueue queue(area);
  QuadrantOrder order;
  const auto width = static_cast<std::size_t>(area.width);
  const std::size_t pixels = width * static_cast<std::size_t>(area.height);
  order.quadrants.reserve(pixels);
  order.ranks.resize(pixels);
  while (const auto quadrant = queue.next()) {
    const Pixel own = own_pixel(*quadrant);
    order.ranks[static_cast<std::size_t>(own.y - area.y) * width +
                static_cast<std::size_t>(own.x - area.x)] =
        static_cast<std::uint32_t>(order.quadrants.size());
    order.quadrants.push_back(*quadrant);
  }
  return order;
}

}  // namespace renderer::progressive
