#pragma once
// Scenes made by programs instead of files.

#include <string_view>

#include "renderer/scene/hills.hpp"

namespace renderer {

inline constexpr int MAX_SPHERES = 2'000'000;
inline constexpr int MAX_ROOM_LIGHTS = 10'000;

/// Makes "spheres:N": the first `n` spheres, in breadth-first order, of E. Haines's sphereflake
/// (SPD "balls"), on a floor, which is object 0. There are three lights. Throws BadInput unless 1
/// <= n <= MAX_SPHERES.
Scene make_spheres(int n);

/// Makes "room:L": a room like the test image of the thesis (4.2.1), with `lights` point lights
/// below its ceiling. It has a table with a glass top on a metal frame in the foreground, and a
/// glazed window. The floor is polished. The walls are slightly specular; their reflections are
/// below one step of an 8-bit image. Throws BadInput unless 1 <= lights <= MAX_ROOM_LIGHTS.
Scene make_room(int lights);

/// A generator of scenes. Users write "name:N".
struct Generator {
  std::string_view name, number;  ///< name and parameter, such as "spheres" and "N"
  int least, most;                ///< smallest and largest permitted N
  Scene (*make)(int n);
};
inline constexpr Generator GENERATORS[] = {{"spheres", "N", 1, MAX_SPHERES, &make_spheres},
                                           {"room", "L", 1, MAX_ROOM_LIGHTS, &make_room},
                                           {"hills", "N", 2, MAX_HILLS, &make_hills}};

}  // namespace renderer
