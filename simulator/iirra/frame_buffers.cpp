#include "simulator/iirra/frame_buffers.hpp"

#include <algorithm>

namespace iirra {

namespace {

bool is_same_place(const SampledCell& a, const SampledCell& b) {
  return a.x == b.x && a.y == b.y && a.side == b.side;
}

machine::Memory& memory() { return machine::this_process().processor().memory(); }

}  // namespace

void FrameBuffers::paint(TaskCell& cell, const SampleTable& samples, int order) {
  const Sizes& sizes = shared_.sizes;
  ++cell.paintings;
  std::vector<renderer::Rgb> colours;
  for (const Point& p : points_of(cell)) colours.push_back(samples.colour_of(p));
  auto painting = shared_.paint_cost([cell = SampledCell(cell), colours = std::move(colours),
                                      area = shared_.area](renderer::Work& work) {
    return renderer::progressive::paint(cell, area, colours, work);
  });
  std::erase_if(blocks_, [&](const Painted& old) {
    if (!is_same_place(old.cell, cell)) return false;
    memory().release(sizes.of(old));
    return true;
  });
  // Splits a block that is too long for a message into strips of whole rows.
  const auto row = 3 * static_cast<std::size_t>(painting.area.width);
  const auto room = shared_.longest - sizes.of(Picture{}) - sizes.of(Painted{});
  const int rows = static_cast<int>(room / std::max<std::size_t>(1, row));
  for (int y = 0; y < painting.area.height; y += rows) {
    Painted strip;
    strip.area = painting.area;
    strip.area.y += y;
    strip.area.height = std::min(rows, painting.area.height - y);
    const auto from = painting.rgb8.begin() + static_cast<std::ptrdiff_t>(row) * y;
    strip.rgb8.assign(from, from + static_cast<std::ptrdiff_t>(row) * strip.area.height);
    strip.cell = cell;
    strip.order = order;
    memory().allocate(sizes.of(strip), "virtual frame buffers", machine::this_process().own_time());
    blocks_.push_back(std::move(strip));
  }
}

Picture FrameBuffers::take() {
  const Sizes& sizes = shared_.sizes;
  Picture picture;
  std::uint64_t bytes = sizes.of(picture);
  while (!blocks_.empty() && bytes + sizes.of(blocks_.front()) <= shared_.longest) {
    bytes += sizes.of(blocks_.front());
    memory().release(sizes.of(blocks_.front()));
    picture.blocks.push_back(std::move(blocks_.front()));
    blocks_.pop_front();
  }
  picture.is_all = blocks_.empty();
  return picture;
}

}  // namespace iirra
