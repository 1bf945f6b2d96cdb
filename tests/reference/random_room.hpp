#pragma once
// Random rooms for radiosity: a box with a lamp below its ceiling, and blocks that stand on the
// floor, float, touch a wall or are stacked, turned by any angle.

#include <cstdint>
#include <string>

namespace radiosity::reference {

/// Makes the text of a .room file, which depends only on the seed. The room is closed. All
/// coordinates of a room have the same number of decimals, from 2 to 15.
std::string make_random_room(std::uint64_t seed);

}  // namespace radiosity::reference
