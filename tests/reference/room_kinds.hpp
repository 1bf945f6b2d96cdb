#pragma once
// Random rooms of kinds that are hard for patches, each seen from three positions.

#include <cstdint>
#include <string>

#include "base/fields.hpp"

namespace radiosity::reference {

enum class RoomKind : std::uint8_t {
  blocks,    ///< rooms of make_random_room()
  lamps,     ///< lamps 1 mm to 20 cm below a level or sloped ceiling
  doors,     ///< an L-shaped room whose arms are divided by a wall with a door
  legs,      ///< a table on thin legs
  slits,     ///< a box around a lamp, with a slit
  corridor,  ///< strongly coloured walls, and a lamp at one end
  spiral,    ///< boxes on a spiral
  windows,   ///< two rooms with a window between, one of them without a lamp
  screens,   ///< two-sided screens that stand
  mirrors,   ///< two mirrors that face each other
};

/// The kinds by name.
const base::Names<RoomKind>& room_kinds();

inline constexpr int ROOM_VIEWS = 3;

/// Makes the text of a .room, which depends only on the arguments. The room is closed. Views 0 to
/// ROOM_VIEWS - 1 are of the whole room, from below, and from a corner. A room of blocks has only
/// one view.
std::string make_room_of_kind(RoomKind kind, std::uint64_t seed, int view);

}  // namespace radiosity::reference
