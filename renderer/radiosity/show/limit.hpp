#pragma once
// Limits that keep bicubic surfaces near the illumination around them: a steep slope at a shadow's
// border must not overshoot it. A cubic lies within its control points (P. Bezier). These are
// limited, as F. Fritsch and R. Carlson, "Monotone Piecewise Cubic Interpolation", SIAM J.
// Numerical Analysis 17(2), 1980, limit slopes.

#include "renderer/radiosity/show/slopes.hpp"

namespace radiosity {

/// Range of the surfaces around a vertex, by colour.
struct Limits {
  Rgb least, most;
};

/// By vertex: the range of the illumination of all patches around it and its twins, extended by a
/// quarter at both ends, but not below half of its minimum.
std::vector<Limits> find_limits(const Mesh& mesh, const Fans& fans, std::span<const Rgb> vertices);

/// The change along an edge at one end, limited. `whole` is the change of the illumination from
/// this end to the other, `there` the change along the edge at the other end. A change is kept
/// - between 0 and 3 times the whole: the edge is then monotone;
/// - if its bend (the whole less the change) has the sign of the bend at the other end and is at
/// most
///   twice as large. A peak over several patches bends at both ends, an edge beside a jump at one
///   (after H. Huynh, "Accurate Monotone Cubic Interpolation", SIAM J. Num. Analysis 30(1), 1993);
/// - or if it makes a bulge below 2 % of the illumination.
/// Others become the nearest of these. Finally, a third of the change is kept within the limits.
Rgb limit_change(const Limits& limits, const Rgb& value, const Rgb& change, const Rgb& whole,
                 const Rgb& there);

/// The mixed derivative nearest to `twist` that keeps the inner control point at a patch's corner
/// within the limits. The point follows from the vertex's illumination and its edges' changes.
Rgb limit_twist(const Limits& limits, const Rgb& value, const Rgb& to_next, const Rgb& to_prev,
                const Rgb& twist);

}  // namespace radiosity
