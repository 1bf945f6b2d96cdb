#pragma once
// E. Haines's Neutral File Format (SPD 3.x).
//
//   v  from X Y Z  at X Y Z  up X Y Z  angle DEGREES  [hither D]  [resolution W H]     required
//   b R G B                                            background, black by default
//   l X Y Z [R G B]                                    without a colour: 1 / sqrt(number of lights)
//   f R G B Kd Ks Shine T IOR                          surface of the primitives that follow it
//   s X Y Z R                                          sphere
//   p N  N x (X Y Z)                                   polygon, flat, concave or not
//   pp N  N x (X Y Z NX NY NZ)                         polygon with normals
//   c X Y Z R  X Y Z R                                 cone or cylinder, open: base and apex
//
// Words may be broken over lines anywhere; only a light's colour must be on the light's line. '#'
// starts a comment. A primitive before any `f` is an error, as is anything degenerate.

#include <istream>
#include <string>

#include "renderer/scene/scene.hpp"

namespace renderer {

/// BadInput "name:line: found ..., expected ...".
Scene parse_nff(std::istream& in, const std::string& name);
/// The same from a file; BadInput if it cannot be read.
Scene load_nff(const std::string& path);

}  // namespace renderer
