#pragma once
// Rooms to try radiosity on: a box with a lamp under its ceiling and blocks that stand on the
// floor, float, touch a wall or are stacked, turned by any angle.

#include <cstdint>
#include <string>

namespace radiosity::reference {

/// The text of a .room; it depends on the seed only. The room is closed; coordinates have 2 to 15
/// decimals, as many throughout a room.
std::string make_random_room(std::uint64_t seed);

}  // namespace radiosity::reference
