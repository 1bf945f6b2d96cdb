#pragma once
// Limits that keep bicubic surfaces near the illumination around them. Without them, a surface
// overshoots where it is steep, at the border of a shadow. A cubic lies within the convex hull of
// its control points (P. Bezier). The control points are limited like the slopes in F. Fritsch and
// R. Carlson, "Monotone Piecewise Cubic Interpolation", SIAM J. Numerical Analysis 17(2), 1980.

#include "renderer/radiosity/show/slopes.hpp"

namespace radiosity {

/// Range of the surfaces around a vertex, for each colour.
struct Limits {
  Rgb least, most;
};

/// For each vertex, the range of the illumination of all patches around it and its twins. The range
/// is extended by a quarter at both ends, but not below half of its minimum.
std::vector<Limits> find_limits(const Mesh& mesh, const Fans& fans, std::span<const Rgb> vertices);

/// Limits the change along an edge at one end. `whole` is the change of the illumination from this
/// end to the other; `there` is the change along the edge at the other end. A change is kept if
/// - it is between 0 and 3 times the whole, which makes the edge monotone;
/// - or its bend (the whole less the change) has the sign of the bend at the other end, and is at
///   most twice as large. A peak over several patches bends at both ends, an edge beside a jump at
///   one (after H. Huynh, "Accurate Monotone Cubic Interpolation", SIAM J. Num. Analysis 30(1),
///   1993);
/// - or it makes a bulge below 2 % of the illumination.
/// Any other change is replaced by the nearest change that would be kept. Finally, the control
/// point, a third of the change from the vertex, is clamped to the limits of the vertex.
Rgb limit_change(const Limits& limits, const Rgb& value, const Rgb& change, const Rgb& whole,
                 const Rgb& there);

/// The mixed derivative nearest to `twist` that keeps the inner control point at a patch's corner
/// within the limits. The point follows from the illumination of the vertex and the changes along
/// its edges.
Rgb limit_twist(const Limits& limits, const Rgb& value, const Rgb& to_next, const Rgb& to_prev,
                const Rgb& twist);

}  // namespace radiosity
