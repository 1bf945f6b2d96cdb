#include "experiments/laboratory/live/tiles.hpp"

#include <algorithm>

namespace laboratory {

namespace {

constexpr std::size_t SIDE = 32;  // side of a tile, pixels

void add_number(std::string& text, std::size_t number) {
  text += static_cast<char>(number & 0xff);
  text += static_cast<char>(number >> 8 & 0xff);
}

}  // namespace

std::string make_tiles(const std::vector<std::uint8_t>& now,
                       const std::vector<std::uint8_t>* before, int width) {
  const auto w = static_cast<std::size_t>(width);
  const std::size_t h = now.size() / 3 / w;
  std::string tiles;
  for (std::size_t y = 0; y < h; y += SIDE)
    for (std::size_t x = 0; x < w; x += SIDE) {
      const std::size_t tile_w = std::min(SIDE, w - x), tile_h = std::min(SIDE, h - y);
      const auto row = [&](const std::vector<std::uint8_t>& picture, std::size_t j) {
        return picture.begin() + static_cast<std::ptrdiff_t>(3 * ((y + j) * w + x));
      };
      const auto length = static_cast<std::ptrdiff_t>(3 * tile_w);
      bool is_same = before != nullptr;
      for (std::size_t j = 0; is_same && j < tile_h; ++j)
        is_same = std::equal(row(now, j), row(now, j) + length, row(*before, j));
      if (is_same) continue;
      for (const std::size_t number : {x, y, tile_w, tile_h}) add_number(tiles, number);
      for (std::size_t j = 0; j < tile_h; ++j) tiles.append(row(now, j), row(now, j) + length);
    }
  return tiles;
}

}  // namespace laboratory
