#pragma once
// Random rooms of kinds that are hard for patches, each seen from three places.

#include <cstdint>
#include <string>

#include "base/fields.hpp"

namespace radiosity::reference {

enum class RoomKind : std::uint8_t {
  blocks,    ///< make_random_room()
  lamps,     ///< lamps 1 mm to 20 cm below a level or sloped ceiling
  doors,     ///< an L-shaped room, its arms divided by a wall with a door
  legs,      ///< a table on thin legs
  slits,     ///< a box around a lamp, with a slit
  corridor,  ///< strongly coloured walls, a lamp at one end
  spiral,    ///< boxes on a spiral
  windows,   ///< two rooms with a window between, one of them without a lamp
  screens,   ///< two-sided screens that stand
  mirrors,   ///< two mirrors that face each other
};

/// Their names.
const base::Names<RoomKind>& room_kinds();

inline constexpr int ROOM_VIEWS = 3;

/// The text of a .room; it depends on the arguments only. The room is closed, and the view, 0 to
/// ROOM_VIEWS - 1, is of the whole room, from below, and from a corner. A room of blocks has one
/// view.
std::string make_room_of_kind(RoomKind kind, std::uint64_t seed, int view);

}  // namespace radiosity::reference
