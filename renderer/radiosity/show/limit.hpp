#pragma once
// Bicubic surfaces stay near the illumination around them: a steep slope at a border of shadow must
// not swing beyond it. A cubic lies within its control points (P. Bezier), and so these are kept in
// range, as F. Fritsch and R. Carlson, "Monotone Piecewise Cubic Interpolation", SIAM J. Numerical
// Analysis 17(2), 1980, keep slopes.

#include "renderer/radiosity/show/slopes.hpp"

namespace radiosity {

/// What the surfaces around a vertex may be, by colour.
struct Limits {
  Rgb least, most;
};

/// By vertex: the range of the illumination of all patches around it, and around its twins, and
/// beyond that a quarter of it; but no less than half of its least.
std::vector<Limits> find_limits(const Mesh& mesh, const Fans& fans, std::span<const Rgb> vertices);

/// The change along an edge at one end, limited: `whole` is that of the illumination from this end
/// to the other, `there` the change along the edge at the other end. It stays as it is if it is
/// between 0 and 3 times the whole, so that the edge is monotone; if the edge bends at the other
/// end as well, as on a peak that several patches carry, by half as much at least (after H. Huynh,
/// "Accurate Monotone Cubic Interpolation", SIAM J. Numerical Analysis 30(1), 1993), while beside a
/// leap it bends at one end only; and if the bulge is below 2 % of the illumination. In any case a
/// third of it is within the limits.
Rgb limit_change(const Limits& limits, const Rgb& value, const Rgb& change, const Rgb& whole,
                 const Rgb& there);

/// The mixed derivative nearest to `twist` with which the inner control point at a corner of a
/// patch, from its vertex's illumination and the changes along its edges, is within the limits.
Rgb limit_twist(const Limits& limits, const Rgb& value, const Rgb& to_next, const Rgb& to_prev,
                const Rgb& twist);

}  // namespace radiosity
