#pragma once
// Random rooms of several kinds that are difficult for patches, each seen from three positions.

#include <cstdint>
#include <string>

#include "base/fields.hpp"

namespace radiosity::reference {

enum class RoomKind : std::uint8_t {
  blocks,    ///< rooms of make_random_room()
  lamps,     ///< lamps between 1 mm and 20 cm below a level or a sloped ceiling
  doors,     ///< an L-shaped room with a wall between its arms, in which there is a door
  legs,      ///< a table on thin legs
  slits,     ///< a box with a slit around a lamp
  corridor,  ///< a corridor with strongly coloured walls, and a lamp at one end
  spiral,    ///< boxes that are arranged on a spiral
  windows,   ///< two rooms with a window between them, one of which has no lamp
  screens,   ///< two-sided screens that stand on the floor
  mirrors,   ///< two mirrors that face each other
};

/// Names of the kinds of rooms.
const base::Names<RoomKind>& room_kinds();

inline constexpr int ROOM_VIEWS = 3;

/// Makes the text of a .room file, which depends only on the arguments. The room is closed. The
/// views, numbered 0 to ROOM_VIEWS - 1, show the whole room, the room from below, and the room from
/// a corner. The kind `blocks` has only view 0.
std::string make_room_of_kind(RoomKind kind, std::uint64_t seed, int view);

}  // namespace radiosity::reference
