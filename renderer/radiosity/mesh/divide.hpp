#pragma once
// One face cut into convex quads.

#include <array>

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

struct Division {
  std::vector<Vec> points;
  std::vector<std::array<std::uint32_t, 4>> quads;  ///< counter-clockwise; neighbours share points
  std::vector<std::array<std::uint32_t, 2>> creases;  ///< edges of quads that lie on a crease
};

/// A face of 4 corners in a grid of along x across; any other in a grid for each corner, between
/// it, the middles of its edges and the centre.
Division divide_face(const Face& face, int refine);

/// The same, but the creases that lie in the face's plane and cross it are edges of quads.
Division divide_face(const Face& face, int refine, std::span<const Crease> creases);

/// Of points, by bilinear interpolation of four corners' positions; s and t in 0..1.
Vec eval_bilinear(std::span<const Vec> corners, double s, double t);

}  // namespace radiosity
