#pragma once
// Random rooms for radiosity: a box with a lamp under its ceiling. Blocks stand on the floor,
// float, touch a wall or are stacked, turned by any angle.

#include <cstdint>
#include <string>

namespace radiosity::reference {

/// Makes the text of a .room, which depends only on the seed. The room is closed. Coordinates have
/// 2 to 15 decimals, the same number throughout a room.
std::string make_random_room(std::uint64_t seed);

}  // namespace radiosity::reference
