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

/// The change along an edge at one end, limited. `whole` is the change of the illumination from
/// this end to the other, `there` the change along the edge at the other end. Kept is a change
/// - between 0 and 3 times the whole: the edge is then monotone;
/// - or whose bend, the whole less the change, has the sign of the bend at the other end and is at
///   most twice that: a peak that several patches carry bends at both ends, an edge beside a leap
///   at one (after H. Huynh, "Accurate Monotone Cubic Interpolation", SIAM J. Numerical Analysis
///   30(1), 1993);
/// - or that makes a bulge below 2 % of the illumination.
/// Any other becomes the nearest of these. Last, a third of it is kept within the limits.
Rgb limit_change(const Limits& limits, const Rgb& value, const Rgb& change, const Rgb& whole,
                 const Rgb& there);

/// The mixed derivative nearest to `twist` with which the inner control point at a corner of a
/// patch, from its vertex's illumination and the changes along its edges, is within the limits.
Rgb limit_twist(const Limits& limits, const Rgb& value, const Rgb& to_next, const Rgb& to_prev,
                const Rgb& twist);

}  // namespace radiosity
