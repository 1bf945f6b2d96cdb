#pragma once
// Limits that keep bicubic surfaces near the illumination around them. Without these limits, a
// surface overshoots where it is steep, at the border of a shadow. A cubic lies within the convex
// hull of its control points (P. Bezier). The control points are limited in the way in which F.
// Fritsch and R. Carlson limit slopes ("Monotone Piecewise Cubic Interpolation", SIAM J. Numerical
// Analysis 17(2), 1980).

#include "renderer/radiosity/show/slopes.hpp"

namespace radiosity {

/// The range of values that the surfaces around a vertex may have, for each colour.
struct Limits {
  Rgb least, most;
};

/// Returns, for each vertex, the range of the illumination of all patches around the vertex and its
/// twins (vertices that a crease has split from it). The range is extended by a quarter of its size
/// at both ends, but not below half of its minimum.
std::vector<Limits> find_limits(const Mesh& mesh, const Fans& fans, std::span<const Rgb> vertices);

/// Limits the change along an edge at one of its ends, where the vertex has the illumination
/// `value`. `whole` is the difference of the illumination between this end and the other; `there`
/// is the change along the edge at the other end. The bend at an end is `whole` less the change at
/// this end. A change is kept
/// - if it is between 0 and 3 times `whole`, which makes the edge monotone;
/// - or if its bend has the sign of the bend at the other end and is at most twice as large. At a
///   peak over several patches, edges bend at both ends. An edge beside a jump bends only at one
///   end (after H. Huynh, "Accurate Monotone Cubic Interpolation", SIAM J. Num. Analysis 30(1),
///   1993);
/// - or if it makes a bulge of less than 2 % of the illumination.
/// Any other change is replaced by the nearest change that would be kept. Finally, the control
/// point, at a third of the change from the vertex, is clamped to the limits of the vertex.
Rgb limit_change(const Limits& limits, const Rgb& value, const Rgb& change, const Rgb& whole,
                 const Rgb& there);

/// Limits the mixed derivative `twist` at a patch's corner. Returns the nearest value that keeps
/// the inner control point within the limits of the vertex. This point follows from the vertex's
/// illumination `value` and the changes along the edges to the next and previous corners.
Rgb limit_twist(const Limits& limits, const Rgb& value, const Rgb& to_next, const Rgb& to_prev,
                const Rgb& twist);

}  // namespace radiosity
