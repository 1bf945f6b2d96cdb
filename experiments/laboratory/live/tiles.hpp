#pragma once
// What has changed in a picture, in a form that pages draw.
#include <cstdint>
#include <string>
#include <vector>

namespace laboratory {

/// The tiles of a picture, rows from the top and 3 bytes a pixel, in which it differs from `before`
/// (null: all of them). Each is 8 bytes, x, y, width and height, whole numbers of two bytes, the
/// lower first, and its pixels. Empty: nothing has changed.
std::string make_tiles(const std::vector<std::uint8_t>& now,
                       const std::vector<std::uint8_t>* before, int width);

}  // namespace laboratory
