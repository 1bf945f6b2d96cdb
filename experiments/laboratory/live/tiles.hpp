#pragma once
// Changed parts of a picture, encoded for pages.
#include <cstdint>
#include <string>
#include <vector>

namespace laboratory {

/// The tiles that differ from `before` (null: all tiles) in a picture with rows from the top and 3
/// bytes a pixel. Each tile is x, y, width and height as 16-bit integers, the lower byte first, and
/// its pixels. Empty if nothing has changed.
std::string make_tiles(const std::vector<std::uint8_t>& now,
                       const std::vector<std::uint8_t>* before, int width);

}  // namespace laboratory
