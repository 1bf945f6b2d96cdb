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
/// beyond that `overshoot` of the range; but no less than half of its least.
std::vector<Limits> find_limits(const Mesh& mesh, const Fans& fans, std::span<const Rgb> vertices,
                                double overshoot);

/// Makes slopes flatter, by one factor for each colour of a vertex and its twins, so that a third
/// of an edge from it along the slope is within its limits. Slopes that are stay as they are.
void limit_slopes(const Mesh& mesh, const Fans& fans, std::span<const Rgb> vertices,
                  std::span<const Limits> limits, std::vector<Slopes<Rgb>>& slopes);

/// The mixed derivative nearest to `twist` with which the inner control point at a corner of a
/// patch, from its vertex's illumination and the changes along its edges, is within the limits.
Rgb limit_twist(const Limits& limits, const Rgb& value, const Rgb& to_next, const Rgb& to_prev,
                const Rgb& twist);

}  // namespace radiosity
