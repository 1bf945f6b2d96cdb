#pragma once
// One face cut into convex quads.

#include <array>

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

using Edge = std::array<std::uint32_t, 2>;  ///< between two points

struct Division {
  std::vector<Vec> points;
  std::vector<std::array<std::uint32_t, 4>> quads;  ///< counter-clockwise; neighbours share points
  std::vector<Edge> creases;                        ///< edges of quads that lie on a crease
};

/// A face of 4 corners becomes a grid of along x across quads; any other a grid for each corner,
/// between the corner, the middles of its edges and the centre.
Division divide_face(const Face& face, int refine);

/// The creases that lie in the face's plane and cross it become edges of quads.
Division divide_face(const Face& face, int refine, std::span<const Crease> creases);

/// The point at (s, t), each 0..1, by bilinear interpolation of four corners.
Vec eval_bilinear(std::span<const Vec> corners, double s, double t);

}  // namespace radiosity
