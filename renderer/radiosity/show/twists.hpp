#pragma once
// The mixed derivatives of the illumination, which Eq 3.4 needs and tangent planes do not give.

#include "renderer/radiosity/show/slopes.hpp"

namespace radiosity {

/// How the slopes change around a vertex: the mean of the planes through its slopes and its
/// neighbours', as slopes are of illuminations. Neighbours' slopes are turned with the normal.
Slopes<Slopes<Rgb>> find_bend(const Mesh& mesh, const Fans& fans,
                              std::span<const Slopes<Rgb>> slopes, std::uint32_t vertex);

/// The mixed derivative at a patch's corner along its edges to `next` and `prev`, for a step of
/// both. Of an uneven quad, whose sides turn from one end to the other, with what its tangent plane
/// adds: a linear function stays one.
Rgb find_twist(const Mesh& mesh, const Wedge& wedge, const Slopes<Rgb>& slopes,
               const Slopes<Slopes<Rgb>>& bend);

}  // namespace radiosity
