#pragma once
// Encoding of a picture's changed parts for live pages.
#include <cstdint>
#include <string>
#include <vector>

namespace laboratory {

/// Encodes the tiles in which picture `now` differs from `before`, or all tiles if `before` is
/// null. A picture has rows from the top and 3 bytes per pixel. Each tile is x, y, width and height
/// as 16-bit integers, lower byte first, then its pixels. Empty if nothing has changed.
std::string make_tiles(const std::vector<std::uint8_t>& now,
                       const std::vector<std::uint8_t>* before, int width);

}  // namespace laboratory
