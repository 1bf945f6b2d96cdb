#pragma once
// Encoding of the parts of a picture that have changed, for live pages.
#include <cstdint>
#include <string>
#include <vector>

namespace laboratory {

/// Encodes the tiles (squares of at most 32 pixels) in which the picture `now` differs from
/// `before`, or all tiles if `before` is null. A picture has rows from the top and 3 bytes per
/// pixel. Each tile is encoded as x, y, width and height in 16-bit integers, lower byte first, and
/// then its pixels. Returns "" if nothing has changed.
std::string make_tiles(const std::vector<std::uint8_t>& now,
                       const std::vector<std::uint8_t>* before, int width);

}  // namespace laboratory
